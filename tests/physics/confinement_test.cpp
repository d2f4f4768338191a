#include <cmath>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using VorticityConfinement = GlTest;

/// A Gaussian eddy about the z axis in the middle of a box, off-centre so that nothing cancels by symmetry.
FluidSetup eddy_in_a_box(double strength) {
    FluidSetup s = unit_tank({32, 32, 6}, 0.0, Advection::SemiLagrangian, 6);
    s.confinement_1_s = strength;
    s.velocity_at_start = [](const glm::dvec3& x) {
        const double dx = x.x - 14.3, dy = x.y - 17.1, w = 0.2 * std::exp(-(dx * dx + dy * dy) / 18.0);
        return glm::dvec3(-w * dy, w * dx, 0.0);
    };
    return s;
}

double energy_after(Gpu& gpu, double strength, int steps) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, eddy_in_a_box(strength));
    double energy = 0.0;
    for (int i = 0; i < steps; ++i) {
        fluid->step(0.5, {}, true);
        energy = fluid->wait_result().diagnostics->kinetic_energy_j;
    }
    return energy;
}

TEST_F(VorticityConfinement, GivesBackWhatTheTransportSmoothsAway) {
    // With it an eddy keeps more of its energy, and does not run away. Measured when the limit was set: 1.32 times as much.
    const double without = energy_after(gpu, 0.0, 40), with = energy_after(gpu, 0.05, 40);
    record("gain", with / without);
    EXPECT_GT(with, 1.02 * without);
    EXPECT_LT(with, 2.0 * without);
}

/// The greatest speed in 400 steps with confinement as strong as a step can take, ten times what would do, of an eddy that begins with 0.36 m/s.
double fastest_overfed(Gpu& gpu, bool driver_is_known) {
    FluidSetup s = eddy_in_a_box(1.0);
    s.cells = {16, 16, 6};
    s.velocity_at_start = [](const glm::dvec3& x) {
        const double dx = x.x - 7.3, dy = x.y - 8.1, w = 0.2 * std::exp(-(dx * dx + dy * dy) / 18.0);
        return glm::dvec3(-w * dy, w * dx, 0.0);
    };
    // A force, though it is none, drives the fluid nobody knows how fast: then there is no limit.
    if (!driver_is_known) s.acceleration_m_s2.emplace();
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    double fastest = 0.0;
    for (int i = 0; i < 400; ++i) {
        fluid->step(0.5, {}, false);
        fastest = std::max(fastest, fluid->wait_result().health.fastest_m_s);
    }
    return fastest;
}

TEST_F(VorticityConfinement, FeedsNoEddyFarBeyondWhatDroveIt) {
    const double limited = fastest_overfed(gpu, true), unlimited = fastest_overfed(gpu, false);
    record("limited_m_s", limited);
    record("unlimited_m_s", unlimited);
    EXPECT_LT(limited, 5.0 * 0.36);
    EXPECT_GT(unlimited, 1.5 * limited);
}

TEST_F(VorticityConfinement, PushesNoHarderThanAStepCanTake) {
    // Steps are 0.5 s: from a strength of 0.5 1/s on eps dt stays 0.25.
    EXPECT_EQ(energy_after(gpu, 0.5, 5), energy_after(gpu, 300.0, 5));
    EXPECT_NE(energy_after(gpu, 0.4, 5), energy_after(gpu, 0.5, 5));
}

TEST_F(VorticityConfinement, DoesNothingToAFluidThatDoesNotTurn) {
    FluidSetup s = unit_tank({16, 14, 12}, 3.0, Advection::SemiLagrangian, 6);
    s.confinement_1_s = 1.0;
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    fluid->step(0.5, {BodyState{.centre_m = {8.0, 7.0, 6.0}}}, false);
    for (const glm::vec3& u : fluid->velocity()) EXPECT_EQ(u, glm::vec3(0.0f));
}

}  // namespace
}  // namespace eddy::gles
