#include "gles/render/fill.h"

#include "gles/render/window.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using FillTest = GlTest;

TEST_F(FillTest, ColoursItsRectangleAndNothingElse) {
    const Texture picture({6, 4}, Format::RGBA8, true);
    fill(gpu, picture, {0, 0}, {6, 4}, {0.0f, 0.0f, 1.0f});
    fill(gpu, picture, {1, 2}, {2, 9}, {1.0f, 0.0f, 0.0f});
    fill(gpu, picture, {4, 0}, {-3, 2}, {0.0f, 1.0f, 0.0f});
    const std::vector<std::uint8_t> rgb = rgb_from_top(gpu, picture);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            const bool red = x >= 1 && x < 3 && y >= 2;
            const std::uint8_t* pixel = &rgb[3 * static_cast<std::size_t>((3 - y) * 6 + x)];
            EXPECT_EQ(pixel[0], red ? 255 : 0) << x << ' ' << y;
            EXPECT_EQ(pixel[1], 0) << x << ' ' << y;
            EXPECT_EQ(pixel[2], red ? 0 : 255) << x << ' ' << y;
        }
}

}  // namespace
}  // namespace eddy::gles
