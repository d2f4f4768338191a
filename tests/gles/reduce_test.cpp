#include "gles/reduce.h"

#include <random>

#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using ReduceTest = GlTest;

const glm::ivec2 kSizes[] = {{1, 1},  {2, 3},  {7, 5},   {16, 16},  {17, 33},
                             {64, 1}, {1, 61}, {100, 3}, {129, 127}};

std::vector<glm::vec4> noise(const glm::ivec2& size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    std::vector<glm::vec4> texels(static_cast<std::size_t>(size.x * size.y));
    for (glm::vec4& t : texels) t = {value(random), value(random), value(random), value(random)};
    return texels;
}

glm::vec4 reduced(Gpu& gpu, const glm::ivec2& size, const std::vector<glm::vec4>& texels,
                  const std::string& mask) {
    Texture source(size, Format::RGBA32F, false), target({3, 2}, Format::RGBA32F, false);
    source.upload(&texels[0].x);
    clear(target);
    Reduce(gpu, "reduce", size, {3, 2}, mask).draw(source, target, {1, 1});
    const std::vector<glm::vec4> got = target.download();
    for (const std::size_t i : {0u, 1u, 2u, 3u, 5u})
        EXPECT_EQ(got[i], glm::vec4(0.0f)) << "texel " << i << " was not asked for";
    return got[4];
}

TEST_F(ReduceTest, SumsOddSizesAsTheProcessorDoes) {
    for (const glm::ivec2& size : kSizes) {
        const std::vector<glm::vec4> texels = noise(size);
        glm::dvec4 sum(0.0);
        for (const glm::vec4& t : texels) sum += glm::dvec4(t);
        const glm::dvec4 got(reduced(gpu, size, texels, ""));
        // Blocks of sqrt(N) values: each sum rounds about 2 sqrt(N) times.
        const double tolerance = 2.0 * std::sqrt(static_cast<double>(texels.size()) + 1.0) * 6e-8;
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(got[c], sum[c], tolerance * sum[c]) << size.x << "x" << size.y;
    }
}

TEST_F(ReduceTest, TakesTheMaximumOfTheChannelsItsMaskNames) {
    for (const glm::ivec2& size : kSizes) {
        const std::vector<glm::vec4> texels = noise(size);
        glm::vec4 most(0.0f);
        double sum = 0.0;
        for (const glm::vec4& t : texels) {
            most = glm::max(most, t);
            sum += t.y;
        }
        const glm::vec4 got = reduced(gpu, size, texels, "vec4(1.0, 0.0, 0.0, 1.0)");
        EXPECT_EQ(got.x, most.x) << size.x << "x" << size.y;
        EXPECT_EQ(got.w, most.w) << size.x << "x" << size.y;
        EXPECT_NEAR(got.y, sum, 1e-5 * sum);
    }
}

TEST_F(ReduceTest, CountsEachTexelOnce) {
    for (const glm::ivec2& size : kSizes) {
        const auto count = static_cast<std::size_t>(size.x * size.y);
        EXPECT_EQ(reduced(gpu, size, std::vector<glm::vec4>(count, glm::vec4(1.0f)), "").z,
                  static_cast<float>(count));
    }
}

}  // namespace
}  // namespace eddy::gles
