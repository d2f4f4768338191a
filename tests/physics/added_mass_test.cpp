#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using AddedMass = GlTest;

/// C_m of a sphere in the middle of a cubic box with slip walls, by a / L (method of fundamental solutions,
/// residual below 1e-4); between the entries the confinement grows as (a/L)^3.
double exact_in_cube(double a_over_l) {
    constexpr double kTable[][2] = {{0.05, 0.50091}, {0.10, 0.50730}, {0.15, 0.52493}, {0.20, 0.56047}};
    for (std::size_t i = 0; i + 1 < std::size(kTable); ++i) {
        if (a_over_l > kTable[i + 1][0]) continue;
        const double low = std::pow(kTable[i][0], 3), high = std::pow(kTable[i + 1][0], 3);
        const double share = (std::pow(a_over_l, 3) - low) / (high - low);
        return kTable[i][1] + share * (kTable[i + 1][1] - kTable[i][1]);
    }
    return kTable[std::size(kTable) - 1][1];
}

/// C_m from the pressure impulse of the first step: the sphere, at rest before, has the velocity a dt after
/// it.
double measured(Gpu& gpu, int n, double radius, const glm::dvec3& offset, const glm::dvec3& direction,
                double dt) {
    const std::unique_ptr<Fluid> fluid =
        make_fluid(gpu, unit_tank(glm::ivec3(n), radius, Advection::SemiLagrangian, 8));
    const BodyState body{.centre_m = glm::dvec3(0.5 * n) + offset, .velocity_m_s = dt * direction};
    fluid->step(dt, {body}, false);
    const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    return -glm::dot(fluid->result(true)->loads[0].force_n, direction) / volume;
}

TEST_F(AddedMass, OfASphereOfSixCellsIsWithinOneAndAFifthOfAPercentOfTheExactValueForItsBox) {
    // Validation case B2. Measured when the limit was set: 0.8 % low, offsets within 0.1 %.
    const double exact = exact_in_cube(6.0 / 64.0);
    for (const glm::dvec3 offset :
         {glm::dvec3(0.0), glm::dvec3(0.5, 0.25, 0.125), glm::dvec3(0.31, 0.47, 0.08)}) {
        const double c = measured(gpu, 64, 6.0, offset, {1.0, 0.0, 0.0}, 0.01);
        record("c_over_exact", c / exact);
        EXPECT_NEAR(c, exact, 0.012 * exact) << "offset " << offset.x;
    }
}

TEST_F(AddedMass, OfASphereOfThreeCellsIsWithinFourPercent) {
    // Measured when the limit was set: 3.7 % low.
    const double exact = exact_in_cube(3.0 / 32.0);
    for (const glm::dvec3 offset :
         {glm::dvec3(0.0), glm::dvec3(0.5, 0.25, 0.125), glm::dvec3(0.31, 0.47, 0.08)}) {
        const double c = measured(gpu, 32, 3.0, offset, {1.0, 0.0, 0.0}, 0.01);
        record("c_over_exact_small", c / exact);
        EXPECT_NEAR(c, exact, 0.04 * exact) << "offset " << offset.x;
    }
}

TEST_F(AddedMass, DoesNotDependOnTheTimeStep) {
    const double c = measured(gpu, 32, 4.0, {0.2, 0.1, 0.3}, {1.0, 0.0, 0.0}, 0.01);
    for (const double dt : {0.0001, 0.001, 0.1})
        EXPECT_NEAR(measured(gpu, 32, 4.0, {0.2, 0.1, 0.3}, {1.0, 0.0, 0.0}, dt), c, 1e-3 * c);
}

TEST_F(AddedMass, IsTheSameInEveryDirection) {
    const double along = measured(gpu, 32, 4.0, glm::dvec3(0.0), {1.0, 0.0, 0.0}, 0.01);
    const double across = measured(gpu, 32, 4.0, glm::dvec3(0.0), {0.0, 0.0, 1.0}, 0.01);
    const double diagonal =
        measured(gpu, 32, 4.0, glm::dvec3(0.0), glm::normalize(glm::dvec3(1.0, 1.0, 1.0)), 0.01);
    EXPECT_NEAR(across, along, 1e-4);
    EXPECT_NEAR(diagonal, along, 1e-3);
}

TEST_F(AddedMass, ASpinningSphereFeelsNoPressure) {
    const std::unique_ptr<Fluid> fluid =
        make_fluid(gpu, unit_tank(glm::ivec3(24), 5.0, Advection::SemiLagrangian, 8));
    fluid->step(0.1, {BodyState{.centre_m = glm::dvec3(12.2, 11.7, 12.4), .spin_rad_s = {0.0, 1.0, 0.0}}},
                false);
    const Load load = fluid->result(true)->loads[0];
    // Turning a sphere moves no surface. What is left is that a plane cut of a cell does not know the sphere
    // is round; for scale: accelerating the sphere to the speed of its own surface would take 0.5 V 5 / 0.1
    // = 1.3e4 N.
    EXPECT_LT(glm::length(load.force_n), 30.0);
}

}  // namespace
}  // namespace eddy::gles
