#include "gles/fluid/cut_cell.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/gles/gl_fixture.h"
#include "tests/gles/reference.h"

namespace eddy::gles {
namespace {

using CutCell = GlTest;

/// h = 1 m, rho = 1, so that every number is in cells and the reference loop can be compared directly.
FluidSetup unit_setup(const glm::ivec3& n, int cycles) {
    FluidSetup s;
    s.cells = n;
    s.cell_m = 1.0;
    s.density_kg_m3 = 1.0;
    s.solver.cycles = cycles;
    return s;
}

std::vector<glm::vec3> random_velocity(const glm::ivec3& n, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&] {
        return 2.0f * static_cast<float>(random()) / static_cast<float>(random.max()) - 1.0f;
    };
    std::vector<glm::vec3> u(static_cast<std::size_t>((n.x + 1) * (n.y + 1) * (n.z + 1)));
    for (glm::vec3& v : u) v = {number(), number(), number()};
    return u;
}

double largest_difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(static_cast<double>(a[i][c]) - b[i][c]));
    return most;
}

/// Runs the same two steps through the shaders and through the plain loop.
void expect_same_as_reference(Gpu& gpu, bool filters) {
    gpu.set_filters_float(filters);
    const glm::ivec3 n(13, 10, 11);
    FluidSetup setup = unit_setup(n, 16);
    setup.bodies = {BodySetup{Sphere{2.3}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    ReferenceFluid reference(n);
    reference.radius = 2.3;

    const std::vector<glm::vec3> u0 = random_velocity(n, 3);
    fluid->set_velocity(u0);
    for (std::size_t i = 0; i < u0.size(); ++i) reference.u[i] = glm::dvec3(u0[i]);

    const double dt = 0.4;
    BodyState body{
        .centre_m = {6.1, 5.3, 4.8}, .velocity_m_s = {0.5, -0.2, 0.3}, .spin_rad_s = {0.1, 0.2, -0.3}};
    for (int step = 0; step < 2; ++step) {
        body.centre_m += dt * body.velocity_m_s;
        fluid->step(dt, {body}, true);
        reference.centre = body.centre_m;
        reference.velocity = body.velocity_m_s;
        reference.spin = body.spin_rad_s;
        reference.advect(dt);
        reference.project(1e-10);

        const StepResult result = *fluid->result(true);
        const std::vector<glm::vec3> u = fluid->velocity();
        // Weighted by the open share of the face: through a sliver of 1e-3 the velocity hangs on rounding in
        // the share (about 1e-5, from the quotient in fraction.glsl), but hardly anything flows.
        double worst = 0.0;
        for (int k = 0; k <= n.z; ++k)
            for (int j = 0; j <= n.y; ++j)
                for (int i = 0; i <= n.x; ++i)
                    for (int c = 0; c < 3; ++c) {
                        const std::size_t at = reference.face(i, j, k);
                        const double open = reference.open(c, i, j, k),
                                     difference = u[at][c] - reference.u[at][c];
                        worst = std::max(worst, std::abs(difference) * (open > 0.0 ? open : 1.0));
                    }
        EXPECT_LT(worst, 2e-4) << "velocity, step " << step;
        const glm::dvec3 force = reference.force() / dt, torque = reference.torque() / dt;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(result.loads[0].force_n[c], force[c], 3e-4 * glm::length(force));
            EXPECT_NEAR(result.loads[0].torque_nm[c], torque[c], 3e-4 * glm::length(force));
        }
    }
    gpu.set_filters_float(true);
}

TEST_F(CutCell, DoesWhatThePlainLoopDoesWithHardwareFiltering) {
    if (!gpu.capabilities().filters_float) GTEST_SKIP() << "this driver lacks OES_texture_float_linear";
    expect_same_as_reference(gpu, true);
}

TEST_F(CutCell, DoesWhatThePlainLoopDoesWithTexelFetches) {
    expect_same_as_reference(gpu, false);
}

TEST_F(CutCell, ProjectionLeavesNoDivergenceNeverAddsEnergyAndIsDoneInOne) {
    // Validation case A6, on grids odd and even.
    for (const glm::ivec3 n : {glm::ivec3(32), glm::ivec3(25, 31, 18)}) {
        FluidSetup setup = unit_setup(n, 12);
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
        fluid->set_velocity(random_velocity(n, 5));
        // A step so short that nothing is carried anywhere: the projection alone.
        fluid->step(1e-12, {}, true);
        const Diagnostics first = *fluid->result(true)->diagnostics;
        EXPECT_LT(first.divergence_max_1_s, 1e-5 * 2.0);
        const std::vector<glm::vec3> once = fluid->velocity();
        fluid->step(1e-12, {}, true);
        const Diagnostics second = *fluid->result(true)->diagnostics;
        EXPECT_LE(second.kinetic_energy_j, first.kinetic_energy_j * (1.0 + 1e-6));
        EXPECT_LT(largest_difference(once, fluid->velocity()), 2e-5);
    }
}

TEST_F(CutCell, ACheckerboardDoesNotSurviveTheProjection) {
    const glm::ivec3 n(16);
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, unit_setup(n, 8));
    std::vector<glm::vec3> u(17 * 17 * 17);
    for (int k = 0; k <= 16; ++k)
        for (int j = 0; j <= 16; ++j)
            for (int i = 0; i <= 16; ++i)
                u[static_cast<std::size_t>((k * 17 + j) * 17 + i)] =
                    glm::vec3((i + j + k) % 2 ? 1.0f : -1.0f);
    fluid->set_velocity(u);
    fluid->step(1e-12, {}, true);
    const Diagnostics d = *fluid->result(true)->diagnostics;
    EXPECT_GT(d.divergence_before_1_s, 5.0);
    EXPECT_LT(d.divergence_max_1_s, 1e-4);
}

TEST_F(CutCell, RestStaysRestWithAFixedBodyInside) {
    // Validation case A7 without buoyancy: not one bit may move in 1000 steps.
    FluidSetup setup = unit_setup({12, 14, 11}, 2);
    setup.bodies = {BodySetup{Sphere{3.2}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    for (int step = 0; step < 1000; ++step) fluid->step(0.1, {BodyState{.centre_m = {6.2, 6.7, 5.1}}}, false);
    for (const glm::vec3& u : fluid->velocity()) ASSERT_EQ(u, glm::vec3(0.0f));
}

TEST_F(CutCell, FluidMomentumIsMinusThatOfTheBodysVolumeInAClosedBox) {
    // Validation identity B8.1: the mixed flux a u + (1 - a) u_solid sums to zero over the box, whatever was
    // done before.
    for (const glm::ivec3 n : {glm::ivec3(24), glm::ivec3(25, 21, 27)}) {
        FluidSetup setup = unit_setup(n, 14);
        setup.bodies = {BodySetup{Sphere{4.0}}};
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
        BodyState body{.centre_m = glm::dvec3(n) * 0.5 + 0.13, .velocity_m_s = {0.3, -0.1, 0.2}};
        for (int step = 0; step < 5; ++step) {
            body.centre_m += body.velocity_m_s;
            fluid->step(1.0, {body}, false);
        }
        ReferenceFluid reference(n);
        reference.radius = 4.0;
        reference.centre = body.centre_m;
        reference.velocity = body.velocity_m_s;
        const std::vector<glm::vec3> u = fluid->velocity();
        for (std::size_t i = 0; i < u.size(); ++i) reference.u[i] = glm::dvec3(u[i]);
        glm::dvec3 sum(0.0);
        for (int a = 0; a < 3; ++a)
            for (int k = 0; k < n.z; ++k)
                for (int j = 0; j < n.y; ++j)
                    for (int i = 0; i < n.x; ++i) sum[a] += reference.flux(a, i, j, k);
        const double volume = 4.0 / 3.0 * std::numbers::pi * 64.0;
        EXPECT_LT(glm::length(sum), 1e-4 * volume * glm::length(body.velocity_m_s));
    }
}

TEST_F(CutCell, TwoRunsAreTheSameToTheLastBit) {
    const auto run = [&] {
        FluidSetup setup = unit_setup({18, 16, 20}, 2);
        setup.bodies = {BodySetup{Sphere{3.0}}};
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
        for (int step = 1; step <= 10; ++step)
            fluid->step(
                0.5, {BodyState{.centre_m = {8.0 + 0.2 * step, 8.0, 10.0}, .velocity_m_s = {0.4, 0.0, 0.0}}},
                false);
        return fluid->velocity();
    };
    EXPECT_EQ(run(), run());
}

TEST_F(CutCell, ResetGoesBackToTheStartExactly) {
    FluidSetup setup = unit_setup({16, 16, 16}, 2);
    setup.bodies = {BodySetup{Sphere{3.0}}};
    setup.smoke = SmokeSetup{};
    setup.sources = {SourceSetup{.centre_m = {4.0, 4.0, 4.0},
                                 .radius_m = 2.0,
                                 .velocity_m_s = glm::dvec3(1.0, 0.5, 0.2),
                                 .smoke_per_s = 1.0}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    const auto run = [&] {
        for (int step = 1; step <= 5; ++step)
            fluid->step(
                0.5, {BodyState{.centre_m = {8.0 + 0.2 * step, 8.0, 9.0}, .velocity_m_s = {0.4, 0.0, 0.0}}},
                false);
        return fluid->velocity();
    };
    const std::vector<glm::vec3> first = run();
    fluid->reset();
    EXPECT_EQ(first, run());
}

TEST_F(CutCell, ANewStepAllocatesNothingAfterTheSecond) {
    FluidSetup setup = unit_setup({16, 16, 16}, 2);
    setup.bodies = {BodySetup{Sphere{3.0}}};
    setup.smoke = SmokeSetup{};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    const auto step = [&] { fluid->step(0.5, {BodyState{.centre_m = {8.0, 8.0, 9.0}}}, true); };
    step();
    step();
    const std::size_t made = gpu.textures().made();
    for (int i = 0; i < 20; ++i) step();
    EXPECT_EQ(gpu.textures().made(), made);
}

TEST_F(CutCell, EvenSmokeStaysEvenWhileABodyMovesThroughIt) {
    // Nothing may be made or eaten at the body's surface (validation case A16): a source fills the box first.
    for (const Advection scheme : {Advection::SemiLagrangian, Advection::MacCormack}) {
        FluidSetup setup = unit_setup({16, 16, 16}, 3);
        setup.bodies = {BodySetup{Sphere{3.0}}};
        setup.smoke = SmokeSetup{};
        setup.solver.advection = scheme;
        setup.sources = {
            SourceSetup{.centre_m = {8.0, 8.0, 8.0}, .radius_m = 40.0, .smoke_per_s = 1.0, .stop_s = 0.9}};
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
        for (int step = 1; step <= 30; ++step)
            fluid->step(
                1.0, {BodyState{.centre_m = {4.0 + 0.25 * step, 8.0, 8.0}, .velocity_m_s = {0.25, 0.0, 0.0}}},
                true);
        std::optional<StepResult> last;
        while (auto result = fluid->result(true)) last = result;
        EXPECT_NEAR(last->diagnostics->smoke_total, 16.0 * 16.0 * 16.0, 16.0 * 16.0 * 16.0 * 1e-6);
    }
}

}  // namespace
}  // namespace eddy::gles
