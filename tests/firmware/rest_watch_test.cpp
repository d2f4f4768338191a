#include "firmware/rest_watch.h"

#include <gtest/gtest.h>

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr double kTank = 0.16, kSlow = 0.5 * kTank / 100.0, kQuick = 2.0 * kTank / 100.0;
const glm::dvec3 kPlace(0.08, 0.08, 0.08);

/// Nothing moves from 0 to `end`, looked at every 20 ms.
RestWatch quiet(Instant end, double speed = kSlow, std::optional<glm::dvec3> hand = kPlace) {
    RestWatch watch(kTank);
    watch.all_moves_at(speed);
    for (Instant t = 0s; t <= end; t += 20ms) watch.see(t, hand, 0);
    return watch;
}

TEST(RestWatch, RestsWhenNothingHasMovedForAWhile) {
    EXPECT_FALSE(quiet(4900ms).may_rest());
    EXPECT_TRUE(quiet(5100ms).may_rest());
    EXPECT_TRUE(quiet(5100ms, kSlow, std::nullopt).may_rest());
}

TEST(RestWatch, HandThatMovesWakesAtOnce) {
    RestWatch watch = quiet(20s);
    watch.see(20020ms, kPlace + glm::dvec3(0.001, 0.0, 0.0), 0);
    EXPECT_FALSE(watch.may_rest());
    EXPECT_FALSE(watch.nobody_here());
}

TEST(RestWatch, HandThatComesOrGoesWakesAtOnce) {
    RestWatch watch = quiet(20s);
    watch.see(20020ms, std::nullopt, 0);
    EXPECT_FALSE(watch.may_rest());
    watch = quiet(20s, kSlow, std::nullopt);
    watch.see(20020ms, kPlace, 0);
    EXPECT_FALSE(watch.may_rest());
}

TEST(RestWatch, ButtonWakesAtOnce) {
    RestWatch watch = quiet(20s);
    watch.see(20020ms, kPlace, 8);
    EXPECT_FALSE(watch.may_rest());
}

TEST(RestWatch, TrembleOfAnEncoderWakesNobodyButADriftDoes) {
    RestWatch watch = quiet(20s);
    for (int n = 0; n < 100; ++n)
        watch.see(20s + n * 20ms, kPlace + glm::dvec3(n % 2 ? 2e-4 : 0.0, 0.0, 0.0), 0);
    EXPECT_TRUE(watch.may_rest());
    bool woke = false;
    for (int n = 0; n < 100; ++n) {
        watch.see(22s + n * 20ms, kPlace + glm::dvec3(1e-5 * n, 0.0, 0.0), 0);
        woke |= !watch.may_rest();
    }
    EXPECT_TRUE(woke);
}

TEST(RestWatch, FluidThatMovesIsNotLeftAlone) {
    EXPECT_FALSE(quiet(60s, kQuick).may_rest());
    EXPECT_TRUE(quiet(60s, kQuick).nobody_here());
    RestWatch watch = quiet(60s, kQuick);
    watch.all_moves_at(kSlow);
    watch.see(60020ms, kPlace, 0);
    EXPECT_FALSE(watch.may_rest());
    watch.see(65100ms, kPlace, 0);
    EXPECT_TRUE(watch.may_rest());
}

TEST(RestWatch, FluidOfWhichNothingIsKnownCountsAsMoving) {
    RestWatch watch(kTank);
    for (Instant t = 0s; t <= 60s; t += 20ms) watch.see(t, kPlace, 0);
    EXPECT_FALSE(watch.may_rest());
}

TEST(RestWatch, WhatIsNoMovementIsJudgedAtTheHandle) {
    RestWatch watch(kTank, 4.0);
    watch.all_moves_at(kSlow);
    for (Instant t = 0s; t <= 20s; t += 20ms) watch.see(t, kPlace, 0);
    watch.see(20020ms, kPlace + glm::dvec3(0.0015, 0.0, 0.0), 0);
    EXPECT_TRUE(watch.may_rest()) << "0.4 mm of the handle";
    watch.see(20040ms, kPlace + glm::dvec3(0.0025, 0.0, 0.0), 0);
    EXPECT_FALSE(watch.may_rest());
}

TEST(RestWatch, WarmOrHeavyFluidIsNeverLeftAlone) {
    Scene scene;
    scene.smoke.emplace();
    scene.temperature.emplace();
    EXPECT_FALSE(moves_by_itself(scene));
    scene.smoke->weight = -0.1;
    EXPECT_FALSE(moves_by_itself(scene)) << "nothing weighs without gravity";
    scene.fluid.gravity_m_s2 = {0.0, -9.81, 0.0};
    EXPECT_TRUE(moves_by_itself(scene));
    scene.smoke.reset();
    scene.temperature->expansion_1_k = 0.003;
    EXPECT_TRUE(moves_by_itself(scene));
}

}  // namespace
}  // namespace eddy
