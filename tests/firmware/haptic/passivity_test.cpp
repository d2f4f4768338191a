#include "firmware/haptic/passivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace eddy {
namespace {

using std::chrono::milliseconds;

/// A handle on a path, a force on it from some network, a fluid that keeps books, and the controller between. Energies are
/// those of the ticks after `from`.
struct Port {
    std::function<double(double)> x_m;
    std::function<double(double)> force_n;        ///< what the network gives at a time
    std::function<double(double)> fluid_force_n;  ///< what the fluid itself gave
    int period_ms = 50;
    double stored_j = 0.0;

    Passivity passivity{};
    double hand_j = 0.0, fluid_j = 0.0, damping_most_n = 0.0;

    void run(int ms, int from_ms = 0) {
        double last = 0.0;
        for (int i = 0; i <= ms; ++i) {
            const double t = 1e-3 * i, x = x_m(t), v = (x_m(t + 1e-6) - x) / 1e-6;
            if (i > from_ms) hand_j -= last * (x - x_m(t - 1e-3));
            passivity.moved_to({x, 0.0, 0.0}, milliseconds(i));
            if (i % period_ms == 0 && i >= 2 * period_ms) {  // the answer to the pose of a period ago
                double work = 0.0;
                for (int k = i - 2 * period_ms; k < i - period_ms; ++k)
                    work -= fluid_force_n(1e-3 * k + 5e-4) * (x_m(1e-3 * (k + 1)) - x_m(1e-3 * k));
                passivity.received(work, stored_j, milliseconds(i - period_ms));
                if (i > from_ms) fluid_j += work;
            }
            const double damping = passivity.damping_n({v, 0.0, 0.0}, 0.0).x;
            last = force_n(t) + damping;
            damping_most_n = std::max(damping_most_n, std::abs(damping));
            passivity.given({last, 0.0, 0.0}, {damping, 0.0, 0.0});
        }
    }
};

double stir(double hz, double t) {
    return 0.02 * std::sin(2.0 * std::numbers::pi * hz * t);
}
double stir_speed(double hz, double t) {
    const double w = 2.0 * std::numbers::pi * hz;
    return 0.02 * w * std::cos(w * t);
}

TEST(Passivity, ALateDragThatDrivesTheHandIsMadeToCostItAsMuchAsTheFluidReceives) {
    // 2 N s/m at 5 Hz, 75 ms late: 0.75 pi x 2 of phase, so all it takes it gives back and more.
    Port port{.x_m = [](double t) { return stir(5.0, t); },
              .force_n = [](double t) { return -2.0 * stir_speed(5.0, t - 0.075); },
              .fluid_force_n = [](double t) { return -2.0 * stir_speed(5.0, t); }};
    port.run(4000, 1000);
    EXPECT_GT(port.fluid_j, 0.5);
    EXPECT_GT(port.hand_j, 0.9 * port.fluid_j);
    EXPECT_LT(port.hand_j, 1.3 * port.fluid_j);
    EXPECT_LE(port.damping_most_n, kMostTrackedNsM * 0.02 * 2.0 * std::numbers::pi * 5.0 * 1.001);
}

TEST(Passivity, AForceThatComesInTimeIsLeftAlone) {
    Port port{.x_m = [](double t) { return stir(1.0, t); },
              .force_n = [](double t) { return -2.0 * stir_speed(1.0, t); },
              .fluid_force_n = [](double t) { return -2.0 * stir_speed(1.0, t); }};
    port.run(4000);
    EXPECT_EQ(port.damping_most_n, 0.0);
}

TEST(Passivity, TheSteadyPullOfAJetComesThroughWhole) {
    // Drawn along by it, held against it, and let swing in it: 0.8 N all the time.
    const double w = 2.0 * std::numbers::pi;
    for (const std::function<double(double)>& path :
         {std::function<double(double)>([](double t) { return 0.05 * t; }),
          {[](double t) { return -0.05 * t; }},
          {[w](double t) { return 0.02 * std::sin(w * t); }}}) {
        Port port{
            .x_m = path, .force_n = [](double) { return 0.8; }, .fluid_force_n = [](double) { return 0.8; }};
        port.run(4000);
        EXPECT_LT(port.damping_most_n, 0.02 * 0.8);
    }
}

TEST(Passivity, WhatTheFluidGivesMayBeGiven) {
    // The hand is drawn along by flow that it stirred before: 40 mJ, all out of the fluid's books.
    Port port{.x_m = [](double t) { return 0.04 * t; },
              .force_n = [](double t) { return t > 1.0 ? 1.0 : 0.0; },
              .fluid_force_n = [](double t) { return t > 1.0 ? 1.0 : 0.0; }};
    port.run(2000);
    EXPECT_LT(port.hand_j, -0.035);
    EXPECT_EQ(port.damping_most_n, 0.0);
}

TEST(Passivity, ANetworkThatDrivesAHandInFluidAtRestIsBraked) {
    // 0.1 N along the motion out of nothing.
    Port port{.x_m = [](double t) { return 0.05 * t; },
              .force_n = [](double) { return 0.1; },
              .fluid_force_n = [](double) { return 0.0; }};
    port.run(3000, 1000);
    EXPECT_NEAR(port.hand_j, 0.0, 0.1 * 0.1 * 0.1);  // a tenth of the 10 mJ it would have given
    EXPECT_GT(port.passivity.damped(), 2000U);
    EXPECT_LT(port.passivity.least_j(), 0.0);
}

TEST(Passivity, TheEnergyOfTheFlowStandsForADebtOnceAndNoMore) {
    Port port{.x_m = [](double t) { return 0.05 * t; },
              .force_n = [](double) { return 0.1; },
              .fluid_force_n = [](double) { return 0.0; },
              .stored_j = 4e-3};
    Port later = port;
    port.run(700);
    EXPECT_EQ(port.damping_most_n, 0.0);  // 3.5 mJ so far
    later.run(4000);
    EXPECT_NEAR(later.hand_j, -4e-3, 1e-3);  // of 20
}

TEST(Passivity, AtRestThereIsNothingToDampAndNothingTrembles) {
    Port port{.x_m = [](double) { return 0.01; },
              .force_n = [](double) { return 3.0; },
              .fluid_force_n = [](double) { return 3.0; }};
    port.run(1000);
    EXPECT_EQ(port.damping_most_n, 0.0);
    EXPECT_EQ(port.passivity.energy_j(), 0.0);
}

TEST(Passivity, DampingAndDragTogetherAreNoMoreThanATrackedVelocityBears) {
    // Ten times the energy that 30 ms of any such damping would pay.
    Port port{.x_m = [](double t) { return 0.05 * t; },
              .force_n = [](double) { return 20.0; },
              .fluid_force_n = [](double) { return 0.0; }};
    port.run(1000);
    for (const double drag_ns_m : {0.0, 2.0, 10.0}) {
        const double damping_ns_m = -port.passivity.damping_n({1.0, 0.0, 0.0}, drag_ns_m).x;
        EXPECT_NEAR(damping_ns_m, std::max(0.0, kMostTrackedNsM - drag_ns_m), 0.01) << drag_ns_m;
    }
}

TEST(Passivity, WhenTheForceIsCutTheBooksBeginAnew) {
    Port port{.x_m = [](double t) { return 0.05 * t; },
              .force_n = [](double) { return 0.1; },
              .fluid_force_n = [](double) { return 0.0; }};
    port.run(1000);
    ASSERT_NE(port.passivity.energy_j(), 0.0);
    port.passivity.begin_anew();
    EXPECT_EQ(port.passivity.energy_j(), 0.0);
    EXPECT_EQ(port.passivity.damping_n({0.1, 0.0, 0.0}, 0.0), glm::dvec3(0.0));
    EXPECT_LT(port.passivity.least_j(), 0.0);  // that is kept
}

}  // namespace
}  // namespace eddy
