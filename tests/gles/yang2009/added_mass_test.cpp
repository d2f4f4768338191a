#include <cmath>
#include <numbers>

#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using Yang2009AddedMass = GlTest;

/// -F / (rho V a) of a sphere of 4 cells in the middle of a closed box of 24^3, accelerated from rest along x
/// by so little that it does not leave its place: one number for each step.
std::vector<double> added_mass(Gpu& gpu, FluidSetup setup, double dt, int steps) {
    const double h = setup.cell_m, radius = 4.0 * h, a = 1e-3 * h / (dt * dt);
    const double inertia = setup.density_kg_m3 * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * a;
    setup.bodies = {BodySetup{Sphere{radius}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    std::vector<double> result;
    for (int step = 1; step <= steps; ++step) {
        BodyState body;
        body.centre_m = glm::dvec3(12.0 * h);
        body.velocity_m_s = {a * dt * step, 0.0, 0.0};
        fluid->step(dt, {body}, false);
        const Load load = fluid->result(true)->loads[0];
        EXPECT_NEAR(load.force_n.y / inertia, 0.0, 1e-3);
        EXPECT_NEAR(load.force_n.z / inertia, 0.0, 1e-3);
        EXPECT_NEAR(glm::length(load.torque_nm) / (inertia * radius), 0.0, 1e-3);
        result.push_back(-load.force_n.x / inertia);
    }
    return result;
}

// Measured with 160 sweeps: 0.266 0.536 0.596 ... 0.680 in step 12 (sphere between cell centres; 0.55 to 0.68
// for others), where the cut cells find 0.523. Voxels overestimate, and divergence left over by earlier
// projections adds to it.
TEST_F(Yang2009AddedMass, OfASphereIsTooLargeByLessThan35Percent) {
    FluidSetup cut = unit_setup(glm::ivec3(24), 160);
    cut.solver.method = Method::CutCell;
    cut.solver.cycles = 8;
    const double right = added_mass(gpu, cut, 1.0, 1).back();
    const double found = added_mass(gpu, unit_setup(glm::ivec3(24), 160), 1.0, 12).back();
    RecordProperty("added_mass_coefficient", std::to_string(found));
    EXPECT_NEAR(right, 0.525, 0.01);
    EXPECT_GT(found, 1.05 * right);
    EXPECT_LT(found, 1.35 * right);
}

TEST_F(Yang2009AddedMass, HalfOfASuddenPushIsFeltInItsFirstStep) {
    const std::vector<double> c = added_mass(gpu, unit_setup(glm::ivec3(24), 160), 1.0, 2);
    EXPECT_NEAR(c[0] / c[1], 0.5, 0.02);
}

TEST_F(Yang2009AddedMass, IsTheSameWhateverTheCellTheStepAndTheFluid) {
    FluidSetup water = unit_setup(glm::ivec3(24), 20);
    const double unit = added_mass(gpu, water, 1.0, 3).back();
    water.cell_m = 0.004;
    water.density_kg_m3 = 998.0;
    EXPECT_NEAR(added_mass(gpu, water, 0.01, 3).back(), unit, 1e-4);
}

}  // namespace
}  // namespace eddy::gles
