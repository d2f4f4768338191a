#include "gles/texture.h"

#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using TexturePoolTest = GlTest;

TEST_F(TexturePoolTest, HandsOutAgainWhatCameBack) {
    TexturePool pool(false);
    const Texture* first = nullptr;
    {
        const TexturePool::Lease lease = pool.lease({8, 4}, Format::R32F);
        first = lease.get();
    }
    const TexturePool::Lease again = pool.lease({8, 4}, Format::R32F);
    EXPECT_EQ(again.get(), first);
    EXPECT_EQ(pool.made(), 1u);
}

TEST_F(TexturePoolTest, NeverHandsOutOneTwice) {
    TexturePool pool(false);
    const TexturePool::Lease a = pool.lease({8, 4}, Format::R32F), b = pool.lease({8, 4}, Format::R32F);
    EXPECT_NE(a.get(), b.get());
    EXPECT_EQ(pool.made(), 2u);
}

TEST_F(TexturePoolTest, TellsSizesAndFormatsApart) {
    TexturePool pool(false);
    { const TexturePool::Lease lease = pool.lease({8, 4}, Format::R32F); }
    const TexturePool::Lease other_format = pool.lease({8, 4}, Format::R16F),
                             other_size = pool.lease({4, 8}, Format::R32F);
    EXPECT_EQ(other_format.get()->format(), Format::R16F);
    EXPECT_EQ(other_size.get()->size(), glm::ivec2(4, 8));
    EXPECT_EQ(pool.made(), 3u);
    EXPECT_EQ(pool.bytes(), 32u * 4 + 32u * 2 + 32u * 4);
}

TEST_F(TexturePoolTest, TakesBackALeaseThatIsAssignedOver) {
    TexturePool pool(false);
    TexturePool::Lease a = pool.lease({8, 4}, Format::R32F), b = pool.lease({8, 4}, Format::R32F);
    const Texture* freed = a.get();
    a = std::move(b);
    EXPECT_EQ(pool.lease({8, 4}, Format::R32F).get(), freed);
    EXPECT_EQ(pool.made(), 2u);
}

TEST_F(TexturePoolTest, CountsTheBytesOfEachFormat) {
    const std::pair<Format, std::size_t> sizes[] = {{Format::R32F, 4},     {Format::RG32F, 8},
                                                    {Format::RGBA32F, 16}, {Format::R16F, 2},
                                                    {Format::RGBA16F, 8},  {Format::RGBA8, 4}};
    for (const auto& [format, bytes] : sizes) {
        const Texture texture({3, 5}, format, false);
        EXPECT_EQ(texture.bytes(), 15 * bytes) << to_string(format);
    }
}

TEST_F(TexturePoolTest, TextureBeyondTheDriversLimitIsRefusedWithBothSizes) {
    const int limit = gpu.capabilities().max_texture_size;
    try {
        const Texture texture({limit + 1, 1}, Format::R32F, false);
        FAIL() << "a texture beyond the limit was made";
    } catch (const GlError& e) {
        EXPECT_NE(std::string(e.what()).find(std::to_string(limit + 1)), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find(std::to_string(limit)), std::string::npos) << e.what();
    }
}

TEST_F(TexturePoolTest, TextureGivesBackWhatWasUploaded) {
    Texture one({3, 2}, Format::R32F, false), four({3, 2}, Format::RGBA32F, false);
    std::vector<float> values(24);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = 0.1f * static_cast<float>(i) - 1e10f * (i == 7);
    one.upload(values.data());
    four.upload(values.data());
    const auto got_one = one.download(), got_four = four.download();
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(got_one[i], glm::vec4(values[i], 0.0f, 0.0f, 1.0f));
        EXPECT_EQ(got_four[i],
                  glm::vec4(values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]));
    }
    clear(four);
    for (const glm::vec4& texel : four.download()) EXPECT_EQ(texel, glm::vec4(0.0f));
}

}  // namespace
}  // namespace eddy::gles
