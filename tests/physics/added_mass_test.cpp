#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using AddedMass = GlTest;

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
