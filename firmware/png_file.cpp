#include "firmware/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <stdexcept>
#include <vector>

#include "firmware/text_file.h"

namespace eddy {

void write_png(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgb) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr))
        throw std::runtime_error(fmt::format("{}: cannot be encoded: {}", file.string(), image.message));
    bytes.resize(size);
    replace_text_file(file, bytes);
}

}  // namespace eddy
