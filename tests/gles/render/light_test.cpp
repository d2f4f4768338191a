#include <gmock/gmock.h>

#include <gtest/gtest.h>
#include <algorithm>

#include "tests/gles/render/rig.h"

namespace eddy::gles {
namespace {

/// The light volume on the CPU: key light in x, fill light in y.
struct LightVolume {
    glm::ivec3 cells;
    std::vector<glm::vec3> values;
    float key(int i, int j, int k) const {
        return values[static_cast<std::size_t>((k * cells.y + j) * cells.x + i)].x;
    }
};

LightVolume light_of(Gpu& gpu, const FluidSetup& fluid, const RenderSetup& render,
                     const StillSmoke::Density& density, const std::vector<BodyState>& bodies) {
    const StillSmoke still(gpu, fluid, density);
    Renderer renderer(gpu, fluid, render);
    renderer.draw(still, bodies);
    const Field<Cells>& light = renderer.light();
    return {light.cells(), unpack_vectors(light.texture().download(), light.layout())};
}

const RenderSetup kFromAbove{.width_px = 16, .height_px = 16, .to_key = {0.0, 1.0, 0.0}};

TEST(Light, IsFullEverywhereInAnEmptyTank) {
    Gpu& gpu = shared_gpu();
    for (bool smoke : {false, true}) {
        const LightVolume light = light_of(gpu, tank(smoke, false), {}, kNone, {});
        for (const glm::vec3& t : light.values) {
            EXPECT_EQ(t.x, 1.0f);
            EXPECT_EQ(t.y, 1.0f);
        }
    }
}

TEST(Light, FallsExponentiallyInUniformSmoke) {
    Gpu& gpu = shared_gpu();
    RenderSetup render = kFromAbove;
    const double sigma = render.optical_density_1_m * 0.005;  // [1/cell]
    for (const glm::dvec3& to_key : {glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.6, 0.8, 0.0)}) {
        render.to_key = to_key;
        const LightVolume light = light_of(gpu, tank(true, false), render, kUniform, {});
        for (int j = 0; j < light.cells.y; ++j) {
            const double to_top = (20.0 - (2 * j + 1)) / to_key.y;
            const double to_side = to_key.x > 0.0 ? (24.0 - 9.0) / to_key.x : 1e9;
            EXPECT_NEAR(light.key(4, j, 5), std::exp(-sigma * std::min(to_top, to_side)),
                        2e-5);  // 20 sums in fp32
        }
    }
}

TEST(Light, IsDarkBehindABodyAndWhereDenseSmokeIsInTheWay) {
    Gpu& gpu = shared_gpu();
    const LightVolume ball =
        light_of(gpu, tank(true, true), kFromAbove, kNone, {ball_at({12.0, 12.0, 11.0})});
    EXPECT_LT(ball.key(5, 2, 5), 0.05f);  // below it
    EXPECT_GT(ball.key(5, 9, 5), 0.95f);  // above it
    EXPECT_GT(ball.key(0, 2, 0), 0.95f);  // beside its shadow

    RenderSetup dense = kFromAbove;
    dense.optical_density_1_m = 400.0;
    const LightVolume below = light_of(gpu, tank(true, false), dense, cloud({12.0f, 14.0f, 11.0f}, 5.0f), {});
    EXPECT_LT(below.key(5, 2, 5), 0.05f);
    EXPECT_GT(below.key(0, 2, 0), 0.99f);
}

TEST(Light, OfABodyIsTheSameWithAndWithoutSmokeInTheScene) {
    Gpu& gpu = shared_gpu();
    const std::vector<BodyState> ball{ball_at({9.0, 11.0, 12.0})};
    const LightVolume with = light_of(gpu, tank(true, true), {}, kNone, ball);
    const LightVolume without = light_of(gpu, tank(false, true), {}, kNone, ball);
    for (std::size_t i = 0; i < with.values.size(); ++i) {
        EXPECT_EQ(with.values[i].x, without.values[i].x);
        EXPECT_EQ(with.values[i].y, without.values[i].y);
    }
}

}  // namespace
}  // namespace eddy::gles
