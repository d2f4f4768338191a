#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using SecondOrder = GlTest;

FluidSetup tank(const glm::ivec3& n, double radius, int time_order, int cycles = 6) {
    FluidSetup s = unit_tank(n, radius, Advection::MacCormack, cycles);
    s.solver.time_order = time_order;
    return s;
}

double distance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    double sum = 0.0, size = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += glm::dot(glm::dvec3(a[i] - b[i]), glm::dvec3(a[i] - b[i]));
        size += glm::dot(glm::dvec3(b[i]), glm::dvec3(b[i]));
    }
    return std::sqrt(sum / size);
}

/// Eddies of two sizes that pull at each other, after 16 s: up to 48 cells from where they were.
std::vector<glm::vec3> eddies(Gpu& gpu, int time_order, int steps) {
    const int n = 64;
    FluidSetup s = tank({n, n, 4}, 0.0, time_order);
    const double k = std::numbers::pi / n;
    s.velocity_at_start = [=](const glm::dvec3& x) {
        return glm::dvec3(
            std::sin(k * x.x) * std::cos(k * x.y) + std::sin(2.0 * k * x.x) * std::cos(k * x.y),
            -std::cos(k * x.x) * std::sin(k * x.y) - 2.0 * std::cos(2.0 * k * x.x) * std::sin(k * x.y), 0.0);
    };
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    for (int i = 0; i < steps; ++i) fluid->step(16.0 / steps, {}, false);
    return fluid->velocity();
}

TEST_F(SecondOrder, ErrorFallsFasterWithTheTimeStep) {
    // Against 64 steps. The limiter of the transport keeps it from order 2.
    const std::vector<glm::vec3> exact = eddies(gpu, 2, 64);
    const auto error = [&](int order, int steps) { return distance(eddies(gpu, order, steps), exact); };
    const double coarse = error(2, 4), fine = error(2, 16);
    record("first_order_16", error(1, 16));
    record("second_order_4", coarse);
    record("second_order_16", fine);
    EXPECT_GT(std::log2(coarse / fine) / 2.0, 1.2);
    EXPECT_LT(coarse, 0.5 * error(1, 16));  // four times the step, half the error
}

TEST_F(SecondOrder, KeepsTheEnergyOfAnEddy) {
    // Validation case A1 without viscosity: nothing should change while it turns.
    const int n = 32;
    const auto kept = [&](int order) {
        FluidSetup s = tank({n, n, 4}, 0.0, order);
        const double k = std::numbers::pi / n;
        s.velocity_at_start = [=](const glm::dvec3& x) {
            return glm::dvec3(std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y),
                              0.0);
        };
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        double energy_j = 0.0;
        for (int i = 0; i < 64; ++i) {
            fluid->step(1.0, {}, true);
            energy_j = fluid->wait_result().diagnostics->kinetic_energy_j;
        }
        return energy_j / (0.25 * n * n * 4.0);
    };
    const double first = kept(1), second = kept(2);
    record("kept_first_order", first);
    record("kept_second_order", second);
    EXPECT_NEAR(second, 1.0, 0.005);
    EXPECT_LT(first, 0.85);
}

TEST_F(SecondOrder, LiftsABallAtRestAsArchimedesSays) {
    FluidSetup s = tank({24, 24, 24}, 4.0, 2, 8);
    s.gravity_m_s2 = {0.0, -1.0, 0.0};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    BodyState ball;
    ball.centre_m = {12.3, 11.8, 12.1};
    for (int i = 0; i < 4; ++i) {
        fluid->step(0.1, {ball}, false);
        EXPECT_NEAR(fluid->wait_result().loads[0].force_n.y / (4.0 / 3.0 * std::numbers::pi * 64.0), 1.0,
                    0.002);
    }
    EXPECT_NEAR(fluid->pressure()[0] - fluid->pressure()[24 * 23], 23.0, 0.02);
}

TEST_F(SecondOrder, IsRefusedWhereTheStepCannotBeCutInTwo) {
    FluidSetup viscous = tank(glm::ivec3(8), 2.0, 2), coupled = viscous, measured = viscous;
    viscous.viscosity_pa_s = 1.0;
    coupled.bodies[0].coupled = Coupled{};
    measured.force_methods = true;
    for (const FluidSetup& setup : {viscous, coupled, measured})
        EXPECT_THROW(make_fluid(gpu, setup), std::logic_error);
}

TEST_F(SecondOrder, DoesNotMindStepsOfDifferentLengths) {
    // A ball at rest under water is lifted as Archimedes says, and an eddy keeps its energy, however time is cut up.
    // With few cycles the pressure must come from the last step, for as long as this one is.
    FluidSetup s = tank({24, 24, 24}, 4.0, 2, 2);
    s.gravity_m_s2 = {0.0, -1.0, 0.0};
    const std::unique_ptr<Fluid> water = make_fluid(gpu, s);
    const BodyState ball{.centre_m = {12.3, 11.8, 12.1}};
    for (const double dt : {0.1, 0.3, 0.02, 0.02, 0.2, 0.05}) {
        water->step(dt, {ball}, false);
        EXPECT_NEAR(water->wait_result().loads[0].force_n.y / (4.0 / 3.0 * std::numbers::pi * 64.0), 1.0,
                    0.004);
    }
    const int n = 32;
    FluidSetup turning = tank({n, n, 4}, 0.0, 2);
    const double k = std::numbers::pi / n;
    turning.velocity_at_start = [=](const glm::dvec3& x) {
        return glm::dvec3(std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y), 0.0);
    };
    const std::unique_ptr<Fluid> eddy = make_fluid(gpu, turning);
    double energy_j = 0.0;
    for (int i = 0; i < 48; ++i) {
        eddy->step(i % 3 == 0 ? 1.5 : 0.4, {}, true);
        energy_j = eddy->wait_result().diagnostics->kinetic_energy_j;
    }
    record("kept_in_uneven_steps", energy_j / (0.25 * n * n * 4.0));
    EXPECT_NEAR(energy_j / (0.25 * n * n * 4.0), 1.0, 0.005);
}

/// Force along x on a ball of 5 cells, step by step, that goes as `x` says.
std::vector<double> pull(Gpu& gpu, int order, double dt, int steps, const std::function<double(double)>& x) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, tank({32, 32, 32}, 5.0, order));
    std::vector<double> force_n;
    for (int i = 1; i <= steps; ++i) {
        BodyState ball;
        ball.centre_m = {x(i * dt), 16.0, 16.0};
        ball.velocity_m_s = {(x(i * dt) - x((i - 1) * dt)) / dt, 0.0, 0.0};
        fluid->step(dt, {ball}, false);
        force_n.push_back(fluid->wait_result().loads[0].force_n.x);
    }
    return force_n;
}

TEST_F(SecondOrder, FeelsTheSameAddedMass) {
    const auto speeding_up = [](double t) { return 16.0 + 0.01 * t * t; };
    const std::vector<double> first = pull(gpu, 1, 0.1, 6, speeding_up),
                              second = pull(gpu, 2, 0.1, 6, speeding_up);
    for (std::size_t i = 0; i < first.size(); ++i)
        EXPECT_NEAR(second[i], first[i], 1e-3 * std::abs(first[i]));
}

TEST_F(SecondOrder, GlidesOverTheCellsNoRougher) {
    // At a steady speed in a straight line the force changes slowly: what is not a straight line through the neighbours
    // is ripple, given as a drag coefficient.
    const auto ripple = [&](int order) {
        const std::vector<double> f = pull(gpu, order, 1.0, 24, [](double t) { return 10.0 + 0.37 * t; });
        double most = 0.0;
        for (std::size_t i = 5; i + 1 < f.size(); ++i)
            most = std::max(most, std::abs(f[i] - 0.5 * (f[i - 1] + f[i + 1])));
        return most / (0.5 * 0.37 * 0.37 * std::numbers::pi * 25.0);
    };
    const double first = ripple(1), second = ripple(2);
    record("ripple_first_order", first);
    record("ripple_second_order", second);
    EXPECT_LT(second, 2.0 * first);
}

}  // namespace
}  // namespace eddy::gles
