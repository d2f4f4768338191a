#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Container = GlTest;

BodySetup round_vessel(double radius) {
    BodySetup body{Sphere{radius}};
    body.inside_out = true;
    return body;
}

double volume(double radius) {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

TEST_F(Container, FilledWithFluidFeelsAllOfItsMassWhenItSpeedsUp) {
    // Fluid without friction in a closed round vessel moves with it: F = -rho V a.
    FluidSetup s = unit_tank(glm::ivec3(22), 0.0, Advection::SemiLagrangian, 8);
    s.bodies.push_back(round_vessel(9.0));
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    std::vector<BodyState> states(1);
    states[0].centre_m = {11.2, 10.9, 11.1};
    for (int i = 0; i < 5; ++i) {
        states[0].velocity_m_s.x += 0.01;
        states[0].centre_m += 0.1 * states[0].velocity_m_s;
        fluid->step(0.1, states, false);
        const double mass = -fluid->wait_result().loads[0].force_n.x / 0.1 / volume(9.0);
        if (i == 4) record("mass_over_exact", mass);
        EXPECT_NEAR(mass, 1.0, 0.01) << "step " << i;
    }
}

}  // namespace
}  // namespace eddy::gles
