#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Stratified = GlTest;

enum class By { Smoke, Heat };

/// A slip box of fluid that is heavier at the bottom: smoke whose density falls linearly to 0 at the lid, N^2 = g w ds/dy;
/// or heat that rises from 0 to 1 there, N^2 = g beta dT/dy.
FluidSetup stratified(const glm::ivec3& n, double frequency, By by) {
    FluidSetup s = unit_tank(n, 0.0, Advection::MacCormack, 6);
    s.gravity_m_s2 = {0.0, -1.0, 0.0};
    if (by == By::Heat) {
        s.temperature = TemperatureSetup{frequency * frequency * n.y, 0.0,
                                         [n](const glm::dvec3& x) { return x.y / n.y; }};
        return s;
    }
    s.smoke = SmokeSetup{};
    s.smoke->weight = frequency * frequency * n.y;
    s.smoke->at_start = [n](const glm::dvec3& x) { return 1.0 - x.y / n.y; };
    return s;
}

TEST_F(Stratified, FluidStaysAtRest) {
    // Validation case A7 (b).
    for (const By by : {By::Smoke, By::Heat}) {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, stratified({16, 20, 12}, 0.05, by));
        for (int i = 0; i < 100; ++i) fluid->step(1.0, {}, false);
        double most = 0.0;
        for (const glm::vec3& u : fluid->velocity())
            most = std::max(most, static_cast<double>(glm::length(u)));
        EXPECT_LT(most, 1e-5 * 0.05 * 20.0);
    }
}

TEST_F(Stratified, InternalWavesSwingAtTheirFrequency) {
    // Validation case A8: omega = N k_h / |k|, here N / sqrt(2) for a square mode and N / sqrt(5) for one twice as high as
    // wide. The mode is started with its velocity alone and timed by its first passage through zero.
    const double square = std::sqrt(0.5), wide = std::sqrt(0.2);
    for (const auto& [n, share, by] : {std::tuple(glm::ivec3(32, 32, 6), square, By::Smoke),
                                       std::tuple(glm::ivec3(32, 32, 6), square, By::Heat),
                                       std::tuple(glm::ivec3(48, 24, 6), wide, By::Smoke)}) {
        const double frequency = 0.02, kx = std::numbers::pi / n.x, ky = std::numbers::pi / n.y;
        FluidSetup s = stratified(n, frequency, by);
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
        const double omega = 0.5 * std::numbers::pi / t;
        record(by == By::Heat ? "heat" : n.x == 32 ? "square" : "wide", omega / (frequency * share));
        EXPECT_NEAR(omega, frequency * share, 0.02 * frequency * share);
    }
}

TEST_F(Stratified, ForcingThatIsAGradientMovesNothing) {
    // f = grad of x y + sin z: the pressure takes all of it; and a curl it cannot take.
    FluidSetup s = unit_tank({16, 14, 12}, 0.0, Advection::SemiLagrangian, 12);
    s.acceleration_m_s2 = VectorFormula{{"y", "x", "cos(z)"}};
    const auto fastest = [&] {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        fluid->step(0.01, {}, false);
        double most = 0.0;
        for (const glm::vec3& u : fluid->velocity())
            most = std::max(most, static_cast<double>(glm::length(u)));
        return most;
    };
    EXPECT_LT(fastest(), 1e-5 * 0.01 * 16.0);
    s.acceleration_m_s2 = VectorFormula{{"y", "-x", "0.0"}};
    EXPECT_GT(fastest(), 0.1 * 0.01 * 16.0);
}

}  // namespace
}  // namespace eddy::gles
