#include "firmware/png_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <vector>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

TEST(PngFile, IsReadBackPixelForPixelByLibpng) {
    const ScratchFolder folder;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 3), std::pair(160, 120)}) {
        std::vector<std::uint8_t> rgb(static_cast<std::size_t>(3 * width * height));
        for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(i * 37 + i / 256);
        const std::string file = folder / "picture.png";
        write_png(file, width, height, rgb);

        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        ASSERT_TRUE(png_image_begin_read_from_file(&image, file.c_str())) << image.message;
        EXPECT_EQ(static_cast<int>(image.width), width);
        EXPECT_EQ(static_cast<int>(image.height), height);
        image.format = PNG_FORMAT_RGB;
        std::vector<std::uint8_t> got(PNG_IMAGE_SIZE(image));
        ASSERT_TRUE(png_image_finish_read(&image, nullptr, got.data(), 0, nullptr)) << image.message;
        EXPECT_EQ(got, rgb) << width << "x" << height;
    }
    EXPECT_EQ(folder.listing(), std::vector<std::string>{"picture.png"});
}

}  // namespace
}  // namespace eddy
