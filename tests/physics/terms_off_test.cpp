#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

// Each term of the physics can be left out; here a run with it and one without differ by what the term says, or not at all.
using TermOff = GlTest;

constexpr double kBallRadius = 3.1, kStep = 0.5;
const double kBallVolume = 4.0 / 3.0 * std::numbers::pi * std::pow(kBallRadius, 3);

/// A ball that moves through a tank of fluid at rest.
FluidSetup with_ball() {
    return unit_tank({17, 16, 18}, kBallRadius, Advection::SemiLagrangian, 10);
}

struct History {
    std::vector<Load> loads;  ///< on the first body, step by step
    std::vector<glm::vec3> velocity;
    double smoke = 0.0;
};

History run(Gpu& gpu, const FluidSetup& setup, int steps = 3, bool moves = true) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    History r;
    for (int n = 1; n <= steps; ++n) {
        std::vector<BodyState> states(setup.bodies.size());
        if (!states.empty()) states[0].centre_m = {8.2, 7.9, 9.1};
        if (moves && !states.empty()) {
            states[0].velocity_m_s = {0.3, 0.2, -0.1};
            states[0].spin_rad_s = {0.0, 0.1, 0.0};
            states[0].centre_m += kStep * n * states[0].velocity_m_s;
        }
        if (states.size() > 1) states[1].centre_m = {3.5, 3.5, 4.0};
        fluid->step(kStep, states, true);
        const StepResult result = fluid->wait_result();
        if (!result.loads.empty()) r.loads.push_back(result.loads[0]);
        r.smoke = result.diagnostics->smoke_total;
    }
    r.velocity = fluid->velocity();
    return r;
}

void expect_same_bits(const History& a, const History& b) {
    EXPECT_EQ(a.velocity, b.velocity);
    ASSERT_EQ(a.loads.size(), b.loads.size());
    for (std::size_t i = 0; i < a.loads.size(); ++i) {
        EXPECT_EQ(a.loads[i].force_n, b.loads[i].force_n) << i;
        EXPECT_EQ(a.loads[i].torque_nm, b.loads[i].torque_nm) << i;
    }
}

double largest(const std::vector<glm::vec3>& u) {
    double most = 0.0;
    for (const glm::vec3& v : u) most = std::max(most, static_cast<double>(glm::length(v)));
    return most;
}

/// a + s (b - a): what is linear in a term goes along this line.
std::vector<glm::vec3> along(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, float s) {
    std::vector<glm::vec3> c(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] + s * (b[i] - a[i]);
    return c;
}
std::vector<glm::vec3> difference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    std::vector<glm::vec3> c(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] - b[i];
    return c;
}

TEST_F(TermOff, ViscosityTakesFromAWaveWhatTheImplicitStepSays) {
    // The slowest slip mode u = sin kx cos ky, v = -cos kx sin ky, so weak that it carries itself nowhere. With friction it is
    // 1 / (1 + nu dt K) of what it is without, K = 8 sin^2(kh/2) / h^2 the grid's own -Laplacian, step by step.
    FluidSetup s = unit_tank({16, 16, 6}, 0.0, Advection::SemiLagrangian, 10);
    const double k = std::numbers::pi / 16.0;
    s.velocity_at_start = [k](const glm::dvec3& x) {
        return 1e-6 *
               glm::dvec3(std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y), 0.0);
    };
    s.solver.viscous_cycles = 6;
    const std::vector<glm::vec3> off = run(gpu, s, 4).velocity;
    s.viscosity_pa_s = 2.0;
    const std::vector<glm::vec3> on = run(gpu, s, 4).velocity;
    const double factor = std::pow(1.0 + 2.0 * kStep * 8.0 * std::pow(std::sin(0.5 * k), 2), -4);
    EXPECT_NEAR(largest(on) / largest(off), factor, 1e-4 * factor);
    EXPECT_LT(factor, 0.8);
}

TEST_F(TermOff, GravityChangesNothingButTheForceByTheWeightOfTheFluidDisplaced) {
    FluidSetup s = with_ball();
    const History off = run(gpu, s);
    s.gravity_m_s2 = {0.2, -0.9, 0.3};
    const History on = run(gpu, s);
    const double weight = kBallVolume * glm::length(s.gravity_m_s2);
    for (std::size_t i = 0; i < on.loads.size(); ++i) {
        const glm::dvec3 lift = on.loads[i].force_n - off.loads[i].force_n;
        EXPECT_LT(glm::length(lift + kBallVolume * s.gravity_m_s2), 0.005 * weight) << "step " << i;
    }
    EXPECT_LT(largest(difference(on.velocity, off.velocity)), 1e-4 * largest(off.velocity));
}

TEST_F(TermOff, TheWeightOfSmokeThatIsEverywhereActsAsMuchMoreGravity) {
    FluidSetup s = with_ball();
    s.gravity_m_s2 = {0.0, -0.5, 0.0};
    const History none = run(gpu, s);
    s.smoke = SmokeSetup{.at_start = [](const glm::dvec3&) { return 0.4; }};
    const History weightless = run(gpu, s);
    expect_same_bits(weightless, none);  // smoke without weight is only seen

    s.smoke->weight = 2.5;
    const History heavy = run(gpu, s);
    s.smoke.reset();
    s.gravity_m_s2 *= 1.0 + 0.4 * 2.5;
    const History more = run(gpu, s);
    for (std::size_t i = 0; i < heavy.loads.size(); ++i)
        EXPECT_LT(glm::length(heavy.loads[i].force_n - more.loads[i].force_n),
                  1e-4 * glm::length(more.loads[i].force_n));
    EXPECT_LT(largest(difference(heavy.velocity, more.velocity)), 1e-4 * largest(more.velocity));
}

TEST_F(TermOff, SmokeThatDoesNotFadeIsWhatFadingSmokeWouldBeTimesItsDecay) {
    FluidSetup s = with_ball();
    s.smoke = SmokeSetup{.at_start = [](const glm::dvec3& x) { return 1.0 + 0.1 * x.x; }};
    const History off = run(gpu, s, 4);
    s.smoke->dissipation_1_s = 0.7;
    const History on = run(gpu, s, 4);
    EXPECT_NEAR(on.smoke / off.smoke, std::exp(-0.7 * 4 * kStep), 1e-5);
    expect_same_bits(on, off);  // smoke without weight moves nothing
}

TEST_F(TermOff, ConfinementAddsToTheFlowInProportionToItsStrength) {
    // One step from a given flow: transport is the same, the projection linear, so twice the strength adds twice as much.
    FluidSetup s = with_ball();
    s.velocity_at_start = [](const glm::dvec3& x) {
        return glm::dvec3(0.3 * std::sin(0.4 * x.y), 0.2 * std::cos(0.3 * x.x), 0.0);
    };
    const History off = run(gpu, s, 1);
    s.confinement_1_s = 0.1;
    const History once = run(gpu, s, 1);
    s.confinement_1_s = 0.2;
    const History twice = run(gpu, s, 1);
    const double added = largest(difference(once.velocity, off.velocity));
    EXPECT_GT(added, 1e-3);
    EXPECT_LT(largest(difference(along(off.velocity, once.velocity, 2.0f), twice.velocity)), 1e-3 * added);
    const glm::dvec3 linear = 2.0 * once.loads[0].force_n - off.loads[0].force_n;
    EXPECT_LT(glm::length(linear - twice.loads[0].force_n), 1e-4 * glm::length(off.loads[0].force_n));
}

TEST_F(TermOff, AForcingThatIsAGradientChangesNothingButThePressure) {
    // f = grad(c x^2 / 2 + g y): the ball feels -rho int f dV = -rho V (c x, g, 0), x of its middle, and nothing flows.
    FluidSetup s = with_ball();
    const History off = run(gpu, s, 3, false);
    s.acceleration_m_s2 = VectorFormula{{"0.05 * x", "-0.4", "0.0"}};
    const History on = run(gpu, s, 3, false);
    const glm::dvec3 expected = -kBallVolume * glm::dvec3(0.05 * 8.2, -0.4, 0.0);
    for (std::size_t i = 0; i < on.loads.size(); ++i)
        EXPECT_LT(glm::length(on.loads[i].force_n - off.loads[i].force_n - expected),
                  0.005 * glm::length(expected));
    // In three steps the forcing alone would have made it 0.6; what is left is what the pressure was not solved for.
    EXPECT_LT(largest(difference(on.velocity, off.velocity)), 1e-4);
}

TEST_F(TermOff, AForcingThatIsTheSameEverywhereIsGravity) {
    FluidSetup s = with_ball();
    s.gravity_m_s2 = {0.25, -0.5, 0.125};
    const History gravity = run(gpu, s);
    s.gravity_m_s2 = glm::dvec3(0.0);
    s.acceleration_m_s2 = VectorFormula{{"0.25", "-0.5", "0.125"}};
    expect_same_bits(run(gpu, s), gravity);
}

TEST_F(TermOff, AJetThatHasNotStartedOrHasStoppedIsNone) {
    FluidSetup s = with_ball();
    const History none = run(gpu, s);
    s.sources = {SourceSetup{.centre_m = {4.0, 8.0, 9.0},
                             .radius_m = 2.0,
                             .velocity_m_s = glm::dvec3(1.0, 0.0, 0.0),
                             .start_s = 1e3}};
    expect_same_bits(run(gpu, s), none);
    s.sources[0].start_s = 0.0;
    s.sources[0].stop_s = 0.0;
    expect_same_bits(run(gpu, s), none);
}

TEST_F(TermOff, AJetPushesABallAsHardAsItIsFast) {
    // The step in which it starts: everything is linear in its velocity, and without one nothing happens.
    FluidSetup s = with_ball();
    const auto force_of = [&](const glm::dvec3& jet) {
        s.sources = {SourceSetup{.centre_m = {4.0, 8.0, 9.0}, .radius_m = 2.0, .velocity_m_s = jet}};
        return run(gpu, s, 1, false).loads[0].force_n;
    };
    const glm::dvec3 none = force_of({0.0, 0.0, 0.0}), once = force_of({0.5, 0.1, 0.0}),
                     thrice = force_of({1.5, 0.3, 0.0});
    EXPECT_EQ(none, glm::dvec3(0.0));
    EXPECT_GT(once.x, 0.0);
    EXPECT_LT(glm::length(thrice - 3.0 * once), 1e-5 * glm::length(thrice));
}

TEST_F(TermOff, AForceThatIsNotAskedForIsZeroAndTheFlowIsTheSame) {
    FluidSetup s = with_ball();
    s.bodies.push_back(BodySetup{Cuboid{{2.0, 3.0, 2.0}}});
    s.viscosity_pa_s = 0.2;
    const History both = run(gpu, s);
    s.bodies[1].force = s.bodies[1].torque = false;
    expect_same_bits(run(gpu, s), both);
    s.bodies[0].torque = false;
    const History no_torque = run(gpu, s);
    EXPECT_EQ(no_torque.velocity, both.velocity);
    EXPECT_EQ(no_torque.loads.back().force_n, both.loads.back().force_n);
    EXPECT_EQ(no_torque.loads.back().torque_nm, glm::dvec3(0.0));
    s.bodies[0].force = false;
    const History neither = run(gpu, s);
    EXPECT_EQ(neither.velocity, both.velocity);
    for (const Load& load : neither.loads) EXPECT_EQ(load.force_n, glm::dvec3(0.0));
}

}  // namespace
}  // namespace eddy::gles
