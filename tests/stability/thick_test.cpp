#include <cmath>
#include <numbers>

#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

// Validation case 15: friction reaches 32 cells in a step, and the solver makes the least effort there is.

using ThickFluid = GlTest;

TEST_F(ThickFluid, ComesToRestWithTheLeastEffortToo) {
    FluidSetup s;
    s.cells = glm::ivec3(25);
    s.cell_m = 0.16 / 25;
    const double dt_s = 0.02;
    s.viscosity_pa_s = 1000.0 * s.density_kg_m3 * s.cell_m * s.cell_m / dt_s;
    for (WallSetup& wall : s.walls) wall.kind = WallKind::NoSlip;
    s.solver.cycles = s.solver.viscous_cycles = 1;
    s.velocity_at_start = [](const glm::dvec3& x) {
        const double k = std::numbers::pi / 0.16;
        return 0.1 *
               glm::dvec3(std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y), 0.0);
    };
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    double most_m_s = 0.0;
    for (int i = 0; i < 60; ++i) {
        fluid->step(dt_s, {}, false);
        const double fastest_m_s = fluid->wait_result().health.fastest_m_s;
        if (i > 5) most_m_s = std::max(most_m_s, fastest_m_s);
    }
    EXPECT_LT(most_m_s, 0.01);
}

}  // namespace
}  // namespace eddy::gles
