#include "firmware/exhibit/screenshot.h"

#include <fmt/format.h>

#include <stdexcept>

#include "firmware/png_file.h"

namespace eddy {

Screenshot::Screenshot(const std::filesystem::path& folder) {
    if (folder.empty()) return;
    request_ = folder / "screenshot.request";
    picture_ = folder / "screenshot.png";
}

bool Screenshot::wanted(Instant now) {
    if (request_.empty() || (looked_ && now - *looked_ < kEvery)) return false;
    looked_ = now;
    std::error_code error;
    return std::filesystem::exists(request_, error);
}

std::string Screenshot::give(int width, int height, std::span<const std::uint8_t> rgb) {
    std::filesystem::path beside = picture_;
    beside += ".new";
    std::string said = fmt::format("the screen is in {}", picture_.string());
    std::error_code error;
    try {
        write_png(beside, width, height, rgb);
        std::filesystem::rename(beside, picture_);
    } catch (const std::exception& e) {
        said = fmt::format("no picture of the screen: {}", e.what());
        std::filesystem::remove(beside, error);
    }
    std::filesystem::remove(request_, error);
    return said;
}

}  // namespace eddy
