#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

namespace eddy {

/// Writes a picture: three bytes a pixel, first row at the top. Throws std::runtime_error if the file cannot
/// be written.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace eddy
