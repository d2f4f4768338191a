#include "firmware/exhibit/line_ring.h"

#include <unistd.h>

#include <algorithm>

namespace eddy {

void LineRing::add(std::string_view line) {
    const std::size_t n = added_.load(std::memory_order_relaxed);
    Line& slot = lines_[n % kLines];
    slot.length = 0;
    const std::string_view cut = line.substr(0, kLength - 1);
    std::copy(cut.begin(), cut.end(), slot.text.begin());
    for (std::size_t i = 0; i < cut.size(); ++i)
        if (slot.text[i] == '\n') slot.text[i] = ' ';
    slot.text[cut.size()] = '\n';
    slot.length = cut.size() + 1;
    added_.store(n + 1, std::memory_order_release);
}

void LineRing::write_to(int fd) const {
    const std::size_t added = added_.load(std::memory_order_acquire);
    for (std::size_t n = added > kLines ? added - kLines : 0; n < added; ++n) {
        const Line& line = lines_[n % kLines];
        if (::write(fd, line.text.data(), line.length) < 0) return;
    }
}

}  // namespace eddy
