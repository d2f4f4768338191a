#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using FrameRate = GlTest;

/// Force on a ball that swings along x, at the end of `duration`, in that many steps; its velocity in a step is its way
/// divided by the time, as in every scene.
double force_at_the_end(Gpu& gpu, Advection advection, int cycles, int steps) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, unit_tank({21, 17, 18}, 3.6, advection, cycles));
    constexpr double kDuration = 1.6;
    const auto x_at = [](double t) { return 9.2 + 1.2 * std::sin(2.0 * std::numbers::pi * t / 16.0); };
    const double dt = kDuration / steps;
    double force = 0.0;
    for (int n = 1; n <= steps; ++n) {
        const double x = x_at(n * dt), v = (x - x_at((n - 1) * dt)) / dt;
        fluid->step(dt, {BodyState{.centre_m = {x, 8.7, 9.2}, .velocity_m_s = {v, 0.0, 0.0}}}, false);
        force = fluid->wait_result().loads[0].force_n.x;
    }
    return force;
}

/// Order from three step lengths, each half the one before: log2 of the ratio of differences.
double order(double coarse, double middle, double fine) {
    return std::log2(std::abs(coarse - middle) / std::abs(middle - fine));
}

TEST_F(FrameRate, ChangesTheForceInProportionToTheStep) {
    // Identity B8.8: the same motion at dt, dt/2, dt/4: first order, as the force is that of the middle of a step.
    for (const Advection advection : {Advection::SemiLagrangian, Advection::MacCormack}) {
        const bool fast = advection == Advection::SemiLagrangian;
        double force[3];
        for (int i = 0; i < 3; ++i) force[i] = force_at_the_end(gpu, advection, 10, 6 << i);
        const double p = order(force[0], force[1], force[2]);
        record(fast ? "order_semi_lagrangian" : "order_maccormack", p);
        record(fast ? "change_semi_lagrangian" : "change_maccormack",
               std::abs(force[1] - force[2]) / std::abs(force[2]));
        EXPECT_NEAR(p, 1.0, 0.3);
    }
}

}  // namespace
}  // namespace eddy::gles
