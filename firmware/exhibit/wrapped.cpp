#include "firmware/exhibit/wrapped.h"

#include <algorithm>

#include "gles/render/font.h"

namespace eddy {

std::vector<std::string> wrapped(const std::string& words, double ems) {
    const gles::Font font;
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        const std::string word = words.substr(at, end - at);
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && font.width_px(longer, 1.0) > ems) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
        at = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

}  // namespace eddy
