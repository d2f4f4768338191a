#include "firmware/quality/force_handover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace eddy {
namespace {

const ForceHandover::Motion kStill;

gles::Load load(double x) {
    return {{x, 0.0, 0.0}, {0.0, 2.0 * x, 0.0}};
}

TEST(ForceHandover, PassesOnWhatItGetsWhenNothingChanges) {
    ForceHandover handover;
    for (int n = 0; n < 100; ++n)
        EXPECT_EQ(handover.hand_on(load(std::sin(n)), kStill, Seconds(0.02 * n)).force_n.x, std::sin(n));
}

TEST(ForceHandover, LastForceStandsUntilTheNewFluidHasSettledAndTheFadeBeginsThere) {
    ForceHandover handover;
    handover.hand_on(load(3.0), kStill, Seconds(1.0));
    handover.begin();
    for (int n = 0; n < ForceHandover::kSettling; ++n)
        EXPECT_EQ(handover.hand_on(load(100.0 * n), kStill, Seconds(1.02 + 0.02 * n)).force_n.x, 3.0);
    const gles::Load first = handover.hand_on(load(-5.0), kStill, Seconds(1.1));
    EXPECT_DOUBLE_EQ(first.force_n.x, 3.0);
    EXPECT_DOUBLE_EQ(first.torque_nm.y, 6.0);
}

TEST(ForceHandover, EndsAtTheNewForceAfterHalfASecondAndHasNoStepOnItsWay) {
    ForceHandover handover;
    handover.hand_on(load(3.0), kStill, Seconds(0.0));
    handover.begin();
    double last = 3.0, most = 0.0;
    for (int n = 1; n <= 60; ++n) {
        const double now = handover.hand_on(load(-5.0), kStill, Seconds(0.01 * n)).force_n.x;
        most = std::max(most, std::abs(now - last));
        last = now;
    }
    EXPECT_EQ(last, -5.0);
    EXPECT_LT(most, 8.0 * 1.5 * 0.01 / ForceHandover::kFade.count() * 1.01);  // the steepest of the fade
}

TEST(ForceHandover, MayBeginAgainBeforeItHasEnded) {
    ForceHandover handover;
    handover.hand_on(load(1.0), kStill, Seconds(0.0));
    handover.begin();
    double before = 0.0;
    for (int n = 1; n <= 10; ++n) before = handover.hand_on(load(2.0), kStill, Seconds(0.02 * n)).force_n.x;
    EXPECT_GT(before, 1.0);
    EXPECT_LT(before, 2.0);
    handover.begin();
    for (int n = 11; n <= 11 + ForceHandover::kSettling; ++n)
        EXPECT_DOUBLE_EQ(handover.hand_on(load(-7.0), kStill, Seconds(0.02 * n)).force_n.x, before);
}

TEST(ForceHandover, AHandThatTurnsMeanwhileIsNoDifferenceBetweenFluids) {
    // Two settings of one fluid, alike but for 2 % of the drag, and a hand that stirs twice a second: they come to 0.4 N.
    for (const double phase : {0.0, 1.0, 2.0, 3.0}) {
        ForceHandover handover;
        double most_off = 0.0;
        for (int n = 0; n < 150; ++n) {
            const double t = 0.02 * n, w = 4.0 * std::acos(-1.0), x = w * t + phase;
            const ForceHandover::Motion motion{{0.2 * std::cos(x), 0.0, 0.0},
                                               {-0.2 * w * std::sin(x), 0.0, 0.0}};
            const auto force_n = [&](double drag) {
                return 0.3 - drag * motion.velocity_m_s.x - 0.1 * motion.acceleration_m_s2.x;
            };
            if (n == 75) handover.begin();
            const double got =
                handover.hand_on(load(force_n(n < 75 ? 2.0 : 2.04)), motion, Seconds(t)).force_n.x;
            most_off = std::max(most_off, std::abs(got - force_n(2.0)));
        }
        EXPECT_LT(most_off, 0.02) << phase;
    }
}

TEST(ForceHandover, WhatAFluttersForceSaysOfAStillHandIsNotBelieved) {
    ForceHandover handover;
    for (int n = 0; n < 75; ++n) {
        const ForceHandover::Motion noise{{1e-4 * std::cos(2.1 * n), 0.0, 0.0},
                                          {5e-3 * std::sin(2.9 * n), 0.0, 0.0}};
        handover.hand_on(load(0.5 + 0.04 * std::sin(1.7 * n)), noise, Seconds(0.02 * n));
    }
    handover.begin();
    const ForceHandover::Motion sets_off{{0.2, 0.0, 0.0}, {10.0, 0.0, 0.0}};
    EXPECT_NEAR(handover.hand_on(load(0.0), sets_off, Seconds(1.5)).force_n.x, 0.5, 0.3);
}

TEST(ForceHandover, ForceThatIsNoNumberGoesThroughAndLeavesNoTrace) {
    const double none = std::nan("");
    for (int when = 0; when < 8; ++when) {
        ForceHandover handover;
        for (int n = 0; n < 40; ++n) {
            if (n == 4) handover.begin();
            const double force =
                handover.hand_on(load(n == when ? none : 1.0), kStill, Seconds(0.02 * n)).force_n.x;
            EXPECT_EQ(std::isnan(force), n == when) << "step " << n << ", none at " << when;
        }
    }
}

TEST(ForceHandover, FirstForceOfAllIsNotFadedIn) {
    ForceHandover handover;
    handover.begin();
    EXPECT_EQ(handover.hand_on(load(4.0), kStill, Seconds(0.0)).force_n.x, 4.0);
}

}  // namespace
}  // namespace eddy
