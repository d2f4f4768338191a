#include "firmware/exhibit/kept.h"

#include <stdexcept>

#include "firmware/text_file.h"

namespace eddy {

std::optional<std::string> kept(const std::filesystem::path& file) {
    try {
        return read_text_file(file);
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

bool keep(const std::filesystem::path& file, std::string_view text) {
    try {
        replace_text_file(file, text);
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace eddy
