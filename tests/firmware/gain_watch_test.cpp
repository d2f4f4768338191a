#include "firmware/gain_watch.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "firmware/fluid_setup.h"
#include "firmware/haptic/stability_limits.h"
#include "firmware/show.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

constexpr Seconds kUsual{0.02};

class GainLimitTest : public gles::GlTest {
  protected:
    /// Of a ball in a tank of 16^3 cells, and what else the scene says.
    FluidSlopes slopes(const std::string& more, double radius_m = 0.025) {
        const Scene scene =
            read_scene(fmt::format("[tank]\ncells = [16, 16, 16]\n[[body]]\nname = \"ball\"\nradius_m = {}\n"
                                   "motion = \"held\"\n{}",
                                   radius_m, more),
                       "test.toml")
                .scene;
        const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
        const HapticOrders orders = orders_for(scene, fluid->setup());
        return measure_slopes(*fluid, scene, {orders.lowest_m, orders.highest_m});
    }
};

TEST_F(GainLimitTest, TheAddedMassFoundIsHalfOfWhatABallDisplaces) {
    const FluidSlopes slopes = this->slopes("");
    const double displaced_kg = 1.2 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.025, 3);
    // The walls of a tank that is three times as wide add to it, and so does what little drag there is in the first step.
    EXPECT_GT(slopes.added_kg, 0.45 * displaced_kg);
    EXPECT_LT(slopes.added_kg, 0.85 * displaced_kg);
    // 1.2 kg/m3, 0.5, pi (25 mm)2 and 0.2 m/s: 0.2 mN s/m, give or take the grid.
    EXPECT_GT(slopes.drag_ns_m, 0.05e-3);
    EXPECT_LT(slopes.drag_ns_m, 2e-3);
}

TEST_F(GainLimitTest, AnObstacleInTheMiddleDoesNotHideTheFluid) {
    const std::string obstacle = "[[body]]\nname = \"rock\"\nradius_m = {}\ncentre_m = [0.08, 0.08, 0.08]\n";
    const FluidSlopes alone = slopes("", 0.015),
                      beside = slopes(fmt::format(fmt::runtime(obstacle), 0.045), 0.015);
    EXPECT_GT(beside.added_kg, 0.8 * alone.added_kg);
    EXPECT_LT(beside.added_kg, 2.0 * alone.added_kg);
}

TEST_F(GainLimitTest, TheBodyKeepsToItsRoom) {
    // A ball that nearly fills the tank can go 5 mm to either side, and its fluid resists that steeply.
    const FluidSlopes tight = slopes("", 0.06);
    EXPECT_GT(tight.added_kg, 0.5 * 1.2 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.06, 3));
    EXPECT_LT(tight.added_kg, 1.0);
    const FluidSlopes off_centre = slopes("[haptics]\ncentre_m = [0.159, 0.08, 0.08]\n");
    EXPECT_GT(off_centre.added_kg, 0.8 * slopes("").added_kg);
    EXPECT_LT(off_centre.added_kg, 2.0 * slopes("").added_kg) << "it went into the wall";
}

TEST_F(GainLimitTest, ABallWithoutRoomAlongOneAxisIsTriedAlongAnother) {
    const Scene scene =
        read_scene(
            "[tank]\nsize_m = [0.06, 0.16, 0.16]\ncells = [6, 16, 16]\n[[body]]\nname = \"ball\"\n"
            "radius_m = 0.025\nmotion = \"held\"\n",
            "test.toml")
            .scene;
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    const HapticOrders orders = orders_for(scene, fluid->setup());
    ASSERT_EQ(orders.lowest_m.x, orders.highest_m.x);
    EXPECT_GT(measure_slopes(*fluid, scene, {orders.lowest_m, orders.highest_m}).added_kg, 0.0);
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
