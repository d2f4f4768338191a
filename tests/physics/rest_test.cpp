#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Rest = GlTest;

double fastest(const Fluid& fluid) {
    double most = 0.0;
    for (const glm::vec3& u : fluid.velocity()) most = std::max(most, static_cast<double>(glm::length(u)));
    return most;
}

/// A tank of water with gravity and one fixed body, cells of 1 cm.
FluidSetup heavy(const glm::ivec3& cells, const Shape& shape, double viscosity_pa_s) {
    FluidSetup s;
    s.cells = cells;
    s.cell_m = 0.01;
    s.density_kg_m3 = 1000.0;
    s.viscosity_pa_s = viscosity_pa_s;
    s.gravity_m_s2 = {0.0, -9.81, 0.0};
    s.bodies = {BodySetup{shape}};
    s.solver.cycles = 8;
    if (viscosity_pa_s > 0.0)
        for (WallSetup& wall : s.walls) wall.kind = WallKind::NoSlip;
    return s;
}

TEST_F(Rest, StaysAtRestWithATurnedCubeInside) {
    // Validation case A7, inviscid and viscous, in a tank that is no cube.
    const double fall = std::sqrt(9.81 * 0.2);  // the speed that falling through the tank would give
    for (const double viscosity : {0.0, 1.0}) {
        const std::unique_ptr<Fluid> fluid =
            make_fluid(gpu, heavy({20, 17, 22}, Cuboid{glm::dvec3(0.06)}, viscosity));
        const BodyState body{.centre_m = {0.1, 0.08, 0.11},
                             .orientation = glm::angleAxis(glm::radians(30.0), glm::dvec3(0.0, 0.0, 1.0))};
        double force = 0.0;
        for (int i = 0; i < 100; ++i) {
            fluid->step(0.01, {body}, false);
            force = fluid->wait_result().loads[0].force_n.y;
        }
        record(viscosity > 0.0 ? "fastest_viscous" : "fastest", fastest(*fluid) / fall);
        record(viscosity > 0.0 ? "weight_viscous" : "weight", force / (1000.0 * 9.81 * 2.16e-4));
        EXPECT_LT(fastest(*fluid) / fall, 1e-5) << "viscosity " << viscosity;
        EXPECT_NEAR(force, 1000.0 * 9.81 * 2.16e-4, 0.01 * 1000.0 * 9.81 * 2.16e-4);
    }
}

}  // namespace
}  // namespace eddy::gles
