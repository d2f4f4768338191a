#include "gles/fluid/resistance.h"

#include <gtest/gtest.h>

#include <numbers>

namespace eddy::gles {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLong = 1e12;  // [s] a step in which all the fluid comes to move

FluidSetup syrup(const Shape& shape) {
    FluidSetup s;
    s.cells = glm::ivec3(1000);
    s.cell_m = 0.001;
    s.density_kg_m3 = 1300.0;
    s.viscosity_pa_s = 2.0;
    s.bodies = {BodySetup{shape}};
    return s;
}

const std::vector<BodyState> kMiddle{{.centre_m = glm::dvec3(0.5)}};

TEST(Resistance, OfABallFarFromWallsIsOneAndAHalfTimesStokes) {
    const double a = 0.001, mass = 1300.0 * 4.0 / 3.0 * kPi * a * a * a;
    const FluidSetup setup = syrup(Sphere{a});
    EXPECT_NEAR(mass * resistance_1_s(setup, kMiddle, 0, false, kLong), 1.5 * 6.0 * kPi * 2.0 * a,
                0.01 * 2.0 * a * 9.0 * kPi);
    const double inertia = 0.4 * mass * a * a;
    EXPECT_NEAR(inertia * resistance_1_s(setup, kMiddle, 0, true, kLong), 1.5 * 8.0 * kPi * 2.0 * a * a * a,
                1e-6 * a * a * a);
}

TEST(Resistance, GrowsTowardsAWallAndInShortSteps) {
    const FluidSetup setup = syrup(Sphere{0.05});
    const double far = resistance_1_s(setup, kMiddle, 0, false, kLong);
    EXPECT_GT(resistance_1_s(setup, {{.centre_m = {0.06, 0.5, 0.5}}}, 0, false, kLong), 5.0 * far);
    EXPECT_GT(resistance_1_s(setup, kMiddle, 0, false, 0.01), 5.0 * far);
}

TEST(Resistance, OfARodGrowsWhereItIsNearAWallItself) {
    // As near with its side as with its end; with the other, it is far.
    const FluidSetup setup = syrup(Capsule{0.02, 0.2});
    const glm::dquat lying = glm::angleAxis(glm::radians(90.0), glm::dvec3(0.0, 0.0, 1.0));
    const auto at = [&](double x, const glm::dquat& orientation) {
        return resistance_1_s(setup, {{.centre_m = {x, 0.5, 0.5}, .orientation = orientation}}, 0, false,
                              kLong);
    };
    const glm::dquat upright(1.0, 0.0, 0.0, 0.0);
    EXPECT_NEAR(at(0.03, upright), at(0.13, lying), 1e-9 * at(0.03, upright));
    EXPECT_LT(at(0.13, upright), 0.5 * at(0.13, lying));
}

TEST(Resistance, IsNothingWithoutViscosity) {
    FluidSetup setup = syrup(Sphere{0.05});
    setup.viscosity_pa_s = 0.0;
    EXPECT_EQ(resistance_1_s(setup, kMiddle, 0, false, 0.01), 0.0);
}

}  // namespace
}  // namespace eddy::gles
