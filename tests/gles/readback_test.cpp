#include "gles/readback.h"

#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using ReadbackTest = GlTest;

void fill(Texture& texture, float value) {
    const std::vector<float> texels(4 * static_cast<std::size_t>(texture.size().x * texture.size().y), value);
    texture.upload(texels.data());
}

TEST_F(ReadbackTest, ReturnsWhatTheTextureHeldWhenAskedOldestFirst) {
    Texture texture({5, 1}, Format::RGBA32F, false);
    Readback readback(gpu, {5, 1});
    for (long tag = 1; tag <= 3; ++tag) {
        fill(texture, static_cast<float>(tag));
        readback.request(texture, tag);
    }
    fill(texture, -1.0f);  // too late to be seen
    for (long tag = 1; tag <= 3; ++tag) {
        const auto result = readback.take(true);
        ASSERT_TRUE(result);
        EXPECT_EQ(result->tag, tag);
        EXPECT_EQ(result->texels, std::vector<glm::vec4>(5, glm::vec4(static_cast<float>(tag))));
    }
    EXPECT_FALSE(readback.take(true)) << "nothing more was asked for";
}

TEST_F(ReadbackTest, DropsTheOldestOfFour) {
    Texture texture({2, 1}, Format::RGBA32F, false);
    Readback readback(gpu, {2, 1});
    for (long tag = 1; tag <= 4; ++tag) {
        fill(texture, static_cast<float>(tag));
        readback.request(texture, tag);
    }
    for (long tag = 2; tag <= 4; ++tag) {
        const auto result = readback.take(true);
        ASSERT_TRUE(result);
        EXPECT_EQ(result->tag, tag);
        EXPECT_EQ(result->texels[1], glm::vec4(static_cast<float>(tag)));
    }
}

TEST_F(ReadbackTest, WithoutWaitingComesInTheEnd) {
    Texture texture({2, 1}, Format::RGBA32F, false);
    fill(texture, 0.5f);
    Readback readback(gpu, {2, 1});
    EXPECT_FALSE(readback.take(false));
    readback.request(texture, 9);
    finish();
    std::optional<Readback::Result> result;
    for (int tries = 0; tries < 1000 && !result; ++tries) result = readback.take(false);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->tag, 9);
    EXPECT_EQ(result->texels[0], glm::vec4(0.5f));
}

}  // namespace
}  // namespace eddy::gles
