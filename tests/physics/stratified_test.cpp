#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Stratified = GlTest;

/// A slip box of fluid that is warmer at the top: heat that rises from 0 to 1 there, N^2 = g beta dT/dy. The same by smoke
/// that weighs are the validation cases A7 and A8.
FluidSetup stratified(const glm::ivec3& n, double frequency) {
    FluidSetup s = unit_tank(n, 0.0, Advection::MacCormack, 6);
    s.gravity_m_s2 = {0.0, -1.0, 0.0};
    s.temperature =
        TemperatureSetup{frequency * frequency * n.y, 0.0, [n](const glm::dvec3& x) { return x.y / n.y; }};
    return s;
}

TEST_F(Stratified, FluidStaysAtRest) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, stratified({16, 20, 12}, 0.05));
    for (int i = 0; i < 100; ++i) fluid->step(1.0, {}, false);
    double most = 0.0;
    for (const glm::vec3& u : fluid->velocity()) most = std::max(most, static_cast<double>(glm::length(u)));
    EXPECT_LT(most, 1e-5 * 0.05 * 20.0);
}

TEST_F(Stratified, InternalWavesSwingAtTheirFrequency) {
    // omega = N k_h / |k|, here N / sqrt(2). The mode is started with its velocity alone and timed by its first passage
    // through zero.
    const glm::ivec3 n(32, 32, 6);
    const double frequency = 0.02, kx = std::numbers::pi / n.x, ky = std::numbers::pi / n.y;
    FluidSetup s = stratified(n, frequency);
    const double amplitude = 1e-3 * frequency * n.y;
    s.velocity_at_start = [=](const glm::dvec3& x) {
        return amplitude *
               glm::dvec3(ky * std::sin(kx * x.x) * std::cos(ky * x.y),
                          -kx * std::cos(kx * x.x) * std::sin(ky * x.y), 0.0) /
               kx;
    };
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const auto mode = [&] {
        const std::vector<glm::vec3> u = fluid->velocity();
        double sum = 0.0;
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x)
                sum += u[static_cast<std::size_t>((2 * (n.y + 1) + y) * (n.x + 1) + x)].y *
                       std::cos(kx * (x + 0.5)) * std::sin(ky * y);
        return sum;
    };
    const double dt = 0.05 / frequency;
    double before = mode(), now = before, t = 0.0;
    while (now * before > 0.0 && t < 10.0 / frequency) {
        before = now;
        fluid->step(dt, {}, false);
        now = mode();
        t += dt;
    }
    t -= dt * now / (now - before);
    const double omega = 0.5 * std::numbers::pi / t, exact = frequency * std::sqrt(0.5);
    record("frequency_over_exact", omega / exact);
    EXPECT_NEAR(omega, exact, 0.02 * exact);
}

}  // namespace
}  // namespace eddy::gles
