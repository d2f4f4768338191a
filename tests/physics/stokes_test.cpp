#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Stokes = GlTest;

/// Creeping flow around a sphere in a cube whose walls the fluid sticks to, radius one fifth of the edge, as in
/// validation/B3 and B4. The sphere moves or turns at its place (the displacement is nothing beside its radius) until the
/// flow is steady, in steps far longer than the grid's own diffusion time.
struct Creeping {
    int n;
    glm::dvec3 offset{0.0};

    double radius() const { return 0.2 * n; }
    double lambda = 0.02 * n * n;  ///< nu dt / h^2

    Load steady(Gpu& gpu, const glm::dvec3& velocity, const glm::dvec3& spin, int steps = 30) const {
        FluidSetup s = unit_tank(glm::ivec3(n), radius(), Advection::SemiLagrangian, 3);
        s.viscosity_pa_s = 1.0;
        s.solver.viscous_cycles = 2;
        for (WallSetup& wall : s.walls) wall.kind = WallKind::NoSlip;
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        const BodyState body{
            .centre_m = glm::dvec3(0.5 * n) + offset, .velocity_m_s = velocity, .spin_rad_s = spin};
        for (int i = 0; i < steps; ++i) fluid->step(lambda, {body}, i + 1 == steps);
        StepResult last = fluid->wait_result();
        while (last.step < steps) last = fluid->wait_result();
        return last.loads[0];
    }
    /// Drag over that in an unbounded fluid, 6 pi mu a U.
    double drag_factor(Gpu& gpu, int steps = 30) const {
        constexpr double kSpeed = 1e-4;
        return -steady(gpu, {kSpeed, 0.0, 0.0}, glm::dvec3(0.0), steps).force_n.x /
               (6.0 * std::numbers::pi * radius() * kSpeed);
    }
};

// By the method of fundamental solutions, for a sphere in the middle.
constexpr double kDrag = 3.12346;

TEST_F(Stokes, TheDragConvergesAtSecondOrderWhereverTheSphereLies) {
    for (const glm::dvec3& offset : {glm::dvec3(0.0), glm::dvec3(0.5), glm::dvec3(0.25, 0.1, 0.4)}) {
        const double coarse = Creeping{16, offset}.drag_factor(gpu, 20) - kDrag,
                     fine = Creeping{24, offset}.drag_factor(gpu, 20) - kDrag;
        const double order = std::log(coarse / fine) / std::log(24.0 / 16.0);
        record("order", order);
        EXPECT_GT(order, 1.7) << "offset " << offset.x;
    }
}

TEST_F(Stokes, TheDragStaysFiniteAndRightInStepsOfAnyLength) {
    // A pressure and a friction that do not know of the same faces push each other up from step to step: this once
    // grew threefold every three steps, at some positions only.
    for (const double lambda : {0.1, 5.0, 300.0, 1e4})
        for (const double offset : {0.0, 0.25, 0.5}) {
            Creeping creeping{16, glm::dvec3(offset, 0.4 * offset, offset)};
            creeping.lambda = lambda;
            const double k = creeping.drag_factor(gpu, 30);
            EXPECT_NEAR(k, kDrag, 0.15 * kDrag) << "nu dt / h^2 = " << lambda << ", offset " << offset;
        }
}

TEST_F(Stokes, DragIsProportionalToVelocityAndReversesWithIt) {
    const Creeping creeping{20, {0.2, 0.1, 0.3}};
    const glm::dvec3 u(1e-4, 0.0, 0.0);
    const double once = creeping.steady(gpu, u, glm::dvec3(0.0), 8).force_n.x;
    EXPECT_NEAR(creeping.steady(gpu, 2.0 * u, glm::dvec3(0.0), 8).force_n.x / once, 2.0, 1e-3);
    EXPECT_NEAR(creeping.steady(gpu, -u, glm::dvec3(0.0), 8).force_n.x / once, -1.0, 1e-4);
}

TEST_F(Stokes, AnOffCentreSphereFeelsReciprocalForceAndTorque) {
    // Lorentz' reciprocal theorem, B8.13: the torque about y from moving along z is the force along z from turning about y.
    const Creeping creeping{32, {5.0, 0.0, 0.0}};
    const double torque = creeping.steady(gpu, {0.0, 0.0, 1e-4}, glm::dvec3(0.0)).torque_nm.y / 1e-4;
    const double force = creeping.steady(gpu, glm::dvec3(0.0), {0.0, 1e-5, 0.0}).force_n.z / 1e-5;
    record("torque_from_translation", torque);
    record("force_from_rotation", force);
    EXPECT_NEAR(torque, force, 0.03 * std::max(std::abs(torque), std::abs(force)));
}

}  // namespace
}  // namespace eddy::gles
