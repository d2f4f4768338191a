#include "firmware/gain_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "firmware/fluid_setup.h"
#include "firmware/haptic/stability_limits.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

constexpr Seconds kUsual{0.02};

class GainLimitTest : public gles::GlTest {};

TEST_F(GainLimitTest, TheAddedMassFoundIsHalfOfWhatABallDisplaces) {
    const Scene scene =
        read_scene(
            "[tank]\ncells = [16, 16, 16]\n[[body]]\nname = \"ball\"\nradius_m = 0.025\nmotion = "
            "\"held\"\n",
            "test.toml")
            .scene;
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    const FluidSlopes slopes = measure_slopes(*fluid, scene);
    const double displaced_kg = scene.fluid.density_kg_m3 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.025, 3);
    // The walls of a tank that is three times as wide add to it, and so does what little drag there is in the first step.
    EXPECT_GT(slopes.added_kg, 0.45 * displaced_kg);
    EXPECT_LT(slopes.added_kg, 0.85 * displaced_kg);
    // 1.2 kg/m3, 0.5, pi (25 mm)2 and 0.2 m/s: 0.2 mN s/m, give or take the grid.
    EXPECT_GT(slopes.drag_ns_m, 0.05e-3);
    EXPECT_LT(slopes.drag_ns_m, 2e-3);
}

TEST(GainLimit, IsHalfOfWhatTheHandleAloneStands) {
    EXPECT_NEAR(most_gain({.drag_ns_m = 1e-3, .added_kg = 0.0}, 2.0, kUsual), 0.5 * 0.15 / 0.02 / 2e-3, 1e-6);
    EXPECT_NEAR(most_gain({.drag_ns_m = 0.0, .added_kg = 1e-5}, 2.0, kUsual), 0.5 * 0.15 / 2e-5, 1e-6);
    EXPECT_TRUE(std::isinf(most_gain({}, 1.0, kUsual)));
}

TEST(GainWatch, ASceneThatMayHaveItsGainHasItAndNothingIsSaid) {
    GainWatch watch(100.0, 1.0);
    watch.learn({.drag_ns_m = 1e-3, .added_kg = 1e-5});
    EXPECT_TRUE(watch.see(kUsual));
    EXPECT_EQ(watch.gain(), 100.0);
    EXPECT_FALSE(watch.see(kUsual));
    EXPECT_FALSE(watch.news());
}

TEST(GainWatch, AFluidThatSlowsDownTakesTheGainWithItStepByStepAndIsSaidOnce) {
    GainWatch watch(1000.0, 1.0);
    watch.learn({.drag_ns_m = 3e-3, .added_kg = 0.0});  // 1250 at 50 Hz, 500 at 20
    watch.see(kUsual);
    EXPECT_EQ(watch.gain(), 1000.0);
    double before = watch.gain();
    for (int i = 0; i < 20; ++i) {
        watch.see(Seconds(0.05));
        EXPECT_GE(watch.gain(), 0.899 * before);
        before = watch.gain();
    }
    EXPECT_NEAR(watch.gain(), 500.0, 50.0);
    EXPECT_GT(watch.changes(), 4);
    EXPECT_TRUE(watch.news());
    EXPECT_FALSE(watch.news());
    for (int i = 0; i < 20; ++i) watch.see(kUsual);
    EXPECT_EQ(watch.gain(), 1000.0);
}

TEST(GainWatch, AnswersThatComeLateCountAsIfTheyCameSeldom) {
    GainWatch watch(1000.0, 1.0);
    watch.learn({.drag_ns_m = 3e-3, .added_kg = 0.0});
    watch.see(kUsual);
    for (int i = 0; i < 20; ++i) watch.see(kUsual, Seconds(0.05));
    EXPECT_NEAR(watch.gain(), 500.0, 50.0);
    EXPECT_THAT(watch.news().value_or(""), testing::HasSubstr("50 answers a second, 50 ms after the hand"));
}

}  // namespace
}  // namespace eddy
