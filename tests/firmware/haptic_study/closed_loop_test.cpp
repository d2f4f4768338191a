#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/haptic/stability_limits.h"
#include "firmware/haptic_study/metrics.h"
#include "firmware/haptic_study/paths.h"
#include "firmware/haptic_study/trials.h"

// The whole haptic loop with a handle that has encoders and feels its motors, in a fluid of known drag and added mass that answers
// a period late. What is known of the fluid is exact; what is tried is the loop.

namespace eddy::haptic_study {
namespace {

constexpr double kRatesHz[] = {20.0, 30.0, 50.0, 75.0};

/// As steep as the gain is limited to.
KnownFluid::Settings steepest(double rate_hz, double times = 1.0) {
    return {.drag_ns_m = times * most_drag_ns_m(Seconds(1.0 / rate_hz)), .added_kg = times * kMostAddedKg};
}

CircleFigures on_circle(ForceLaw law, double rate_hz) {
    const KnownFluid::Settings soft{.drag_ns_m = 1.5, .added_kg = 0.07};
    KnownFluid reference(soft), fluid(soft);
    return circle_figures(fluid, law, rate_hz, reference_forces(reference));
}

TEST(ClosedLoop, ModelIsSmoothNearTheTruthAndEarlyAtEveryRate) {
    for (const double rate_hz : kRatesHz) {
        const CircleFigures model = on_circle(ForceLaw::Model, rate_hz),
                            filter = on_circle(ForceLaw::Filter, rate_hz);
        EXPECT_LT(model.roughness, 0.005) << rate_hz;
        EXPECT_LT(model.rmse, 0.6 * filter.rmse) << rate_hz;
        ASSERT_TRUE(model.half_rise_s && filter.half_rise_s);
        EXPECT_LE(*model.half_rise_s, 0.5 * *filter.half_rise_s) << rate_hz;
        EXPECT_LT(model.lag_s, 0.5 * filter.lag_s) << rate_hz;
    }
    // The truth is the same whatever the rate, and so is what the hand gets.
    EXPECT_NEAR(on_circle(ForceLaw::Model, 20.0).rmse, on_circle(ForceLaw::Model, 75.0).rmse, 0.01);
}

TEST(ClosedLoop, HalfOfTheForceIsHalfOfWhatItChangesBy) {
    // Of a jet, 0.8 N before the hand sets off; 0.3 N more a tenth of a second later, in 100 ms.
    std::vector<glm::dvec3> forces;
    for (int ms = 0; ms < 400; ++ms)
        forces.emplace_back(0.8 + 0.003 * std::clamp(ms - 100, 0, 100), 0.0, 0.0);
    const std::optional<double> half_s = half_rise_s(forces);
    ASSERT_TRUE(half_s);
    EXPECT_NEAR(*half_s, 0.150, 0.001);
    for (glm::dvec3& force : forces) force = -force;  // the other way the same
    EXPECT_NEAR(half_rise_s(forces).value_or(0.0), 0.150, 0.001);
}

TEST(ClosedLoop, APullTheWrongWayIsNoPull) {
    const glm::dvec3 given(0.8, 0.0, 0.0);
    EXPECT_EQ(pull_error(given, given), 0.0);
    EXPECT_NEAR(pull_error({0.784, 0.0, 0.0}, given), 0.02, 1e-12);
    EXPECT_DOUBLE_EQ(pull_error({0.0, 0.8, 0.0}, given), std::numbers::sqrt2);
    EXPECT_DOUBLE_EQ(pull_error(-given, given), 2.0);
}

TEST(ClosedLoop, StirringCostsTheHandEnergyInEveryCycle) {
    for (const double rate_hz : kRatesHz)
        for (const double hz : kStirsHz) {
            KnownFluid fluid({.drag_ns_m = 1.5, .added_kg = 0.07});
            const StirFigures stir = stir_figures(fluid, ForceLaw::Model, rate_hz, hz);
            EXPECT_GT(stir.least_cycle_j, 0.95 * stir.drag_j) << rate_hz << ' ' << hz;
            EXPECT_LT(stir.mean_cycle_j, 1.1 * stir.drag_j) << rate_hz << ' ' << hz;
            EXPECT_LT(stir.received_j, stir.drag_j) << rate_hz << ' ' << hz;
        }
    // Held and filtered, drag at 5 Hz comes more than a quarter of a turn late and drives the hand.
    KnownFluid fluid({.drag_ns_m = 1.5, .added_kg = 0.07});
    EXPECT_LT(stir_figures(fluid, ForceLaw::Filter, 20.0, 5.0).least_cycle_j, 0.0);
}

TEST(ClosedLoop, ComesToRestWhoeverHoldsTheHandle) {
    for (const double rate_hz : kRatesHz)
        for (const Holder holder : {Holder::Arm, Holder::StiffArm, Holder::LetsGo}) {
            KnownFluid fluid(steepest(rate_hz));
            const Swing left = swing_figures(coming_to_rest(fluid, ForceLaw::Model, rate_hz, holder));
            EXPECT_LT(left.force_n, 0.05) << rate_hz << ' ' << to_string(holder);
            EXPECT_LT(left.position_m, 1e-4) << rate_hz << ' ' << to_string(holder);
        }
}

// What takes energy out has a velocity that comes late, as all have; were it as steep as it liked, it would drive the handle.
TEST(ClosedLoop, AHandleLetGoOutOfABriskStirComesToRest) {
    for (const double rate_hz : kRatesHz)
        for (const double stir_hz : kLetGoHz) {
            KnownFluid fluid(steepest(rate_hz));
            const Swing left =
                swing_figures(coming_to_rest(fluid, ForceLaw::Model, rate_hz, Holder::LetsGo, stir_hz));
            EXPECT_LT(left.force_n, 0.05) << rate_hz << ' ' << stir_hz;
            EXPECT_LT(left.position_m, 1e-4) << rate_hz << ' ' << stir_hz;
        }
}

TEST(ClosedLoop, WhatAFlowMakesOfAHandleIsItsForceOnThatHandlesMass) {
    // 0.03 N at 2 Hz on a mass of 0.15 kg with hardly any damping: 0.03 / (m w^2) = 1.27 mm.
    std::vector<Felt> fixed;
    for (int i = 0; i < 3000; ++i)
        fixed.push_back({glm::dvec3(0.0), {0.4 + 0.03 * std::cos(4e-3 * std::numbers::pi * i), 0.0, 0.0}});
    const Swing carried = carried_figures(fixed, Holder::LetsGo);
    EXPECT_NEAR(carried.force_n, 0.03, 0.003);  // about a parabola
    EXPECT_NEAR(carried.position_m, 1.27e-3, 0.1e-3);
    EXPECT_LT(carried_figures(fixed, Holder::Arm).position_m, 0.4e-3);
}

TEST(ClosedLoop, AHandleFixedWhereAnotherCameToRestFeelsTheFlowThereToTheEnd) {
    // Seven seconds of rest: the dead man's switch would let go of a handle that keeps so still.
    const std::vector<Felt> rested(7000, Felt{{0.01, -0.02, 0.005}, {}});
    KnownFluid jet({.drag_ns_m = 1.5, .added_kg = 0.07, .push_n = {0.8, 0.0, 0.0}});
    const std::vector<Felt> fixed = fixed_there(jet, ForceLaw::Model, 50.0, rested);
    ASSERT_GT(fixed.size(), 4000U);
    EXPECT_LT(glm::distance(fixed.back().position_m, rested.back().position_m), 1e-9);
    for (std::size_t i = fixed.size() - 2000; i < fixed.size(); ++i)
        ASSERT_NEAR(fixed[i].force_n.x, 0.8, 0.016) << i;
}

TEST(ClosedLoop, RestIsAsStillAsANumberSaysOrAsTheFlowLets) {
    EXPECT_TRUE(rests({.force_n = 0.049, .position_m = 0.9e-4}, {}));
    EXPECT_FALSE(rests({.force_n = 0.051, .position_m = 0.0}, {}));
    EXPECT_FALSE(rests({.force_n = 0.0, .position_m = 1.1e-4}, {}));
    EXPECT_TRUE(rests({.force_n = 0.09, .position_m = 1.9e-3}, {.force_n = 0.05, .position_m = 1e-3}));
    EXPECT_FALSE(rests({.force_n = 0.09, .position_m = 2.1e-3}, {.force_n = 0.05, .position_m = 1e-3}));
}

TEST(ClosedLoop, AtTwiceTheLimitTheFilterDrivesAHandleThatIsLetGo) {
    KnownFluid fluid(steepest(50.0, 2.0));
    EXPECT_GT(swing_figures(coming_to_rest(fluid, ForceLaw::Filter, 50.0, Holder::LetsGo)).force_n, 0.5);
}

TEST(ClosedLoop, TheSteadyPullOfAJetComesThrough) {
    for (const double rate_hz : kRatesHz)
        for (const Holder holder : {Holder::Fixed, Holder::Arm}) {
            KnownFluid fluid({.drag_ns_m = 1.5, .added_kg = 0.07, .push_n = {0.8, 0.0, 0.0}});
            Handle handle(holder, [](Seconds) { return glm::dvec3(0.0); });
            const Play held = play(fluid, handle, {ForceLaw::Model, rate_hz, Seconds(4.0), {}});
            EXPECT_NEAR(held.ticks.back().force_n.x, 0.8, 0.02 * 0.8) << rate_hz << ' ' << to_string(holder);
        }
}

TEST(ClosedLoop, IsRepeatableBitForBit) {
    const auto last = [] {
        KnownFluid fluid({});
        Handle handle(Holder::Arm, circle(1.0));
        return play(fluid, handle, {ForceLaw::Model, 30.0, Seconds(3.0), {}}).ticks.back();
    };
    const Felt a = last(), b = last();
    EXPECT_EQ(a.force_n, b.force_n);
    EXPECT_EQ(a.position_m, b.position_m);
}

}  // namespace
}  // namespace eddy::haptic_study
