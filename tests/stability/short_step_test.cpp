#include <algorithm>
#include <cmath>
#include <numbers>

#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

// Validation case 3: a step that takes next to no time, in which the body stops.

using ShortStep = GlTest;

TEST_F(ShortStep, ThatMeetsABlowDoesNotShakeTheStepsAfterIt) {
    FluidSetup setup;
    setup.cells = glm::ivec3(8);
    setup.cell_m = 0.02;
    setup.solver.cycles = 1;
    setup.bodies = {BodySetup{Sphere{0.032}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    // Energy in units of that of the fluid it displaces, at its own fastest.
    const double unit_j =
        0.5 * setup.density_kg_m3 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.032, 3) * 0.15 * 0.15;
    BodyState ball{.centre_m = glm::dvec3(0.08)};
    double most_j = 0.0, time_s = 0.0;
    for (int n = 0; n < 60; ++n) {
        const double dt = n % 10 == 9 ? 4e-5 : 0.02;
        time_s += dt;
        const double x_m = 0.08 + 0.024 * std::sin(2.0 * std::numbers::pi * time_s);
        ball.velocity_m_s.x = dt < 0.02 ? 0.0 : (x_m - ball.centre_m.x) / dt;  // placed, not moved
        ball.centre_m.x = x_m;
        fluid->step(dt, {ball}, true);
        most_j = std::max(most_j, fluid->wait_result().diagnostics->kinetic_energy_j);
    }
    // Measured: 1.5; 200 without the guard.
    EXPECT_LT(most_j, 3.0 * unit_j);
}

TEST_F(ShortStep, LeavesThickFluidThatGravityHoldsAtRest) {
    FluidSetup setup;
    setup.cells = glm::ivec3(8);
    setup.cell_m = 0.02;
    setup.density_kg_m3 = setup.viscosity_pa_s = 1260.0;
    setup.gravity_m_s2 = {0.0, -9.81, 0.0};
    for (WallSetup& wall : setup.walls) wall.kind = WallKind::NoSlip;
    setup.bodies = {BodySetup{Sphere{0.032}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    double fastest_m_s = 0.0;
    for (int n = 0; n < 40; ++n) {
        fluid->step(n % 10 == 9 ? 4e-5 : 0.02, {BodyState{.centre_m = glm::dvec3(0.08)}}, false);
        fastest_m_s = std::max(fastest_m_s, fluid->wait_result().health.fastest_m_s);
    }
    // Measured: 2e-9 m/s; 3 mm/s where that step has no pressure.
    EXPECT_LT(fastest_m_s, 1e-5);
}

}  // namespace
}  // namespace eddy::gles
