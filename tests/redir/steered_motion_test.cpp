#include "tests/redir/steered_motion.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hal/haptic/falcon/rig.h"

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;

TEST(SteeredMotion, GoesFromOneAimToTheNextWithoutALeap) {
    SteeredMotion hand(
        std::make_unique<Path>([](double t) { return glm::dvec3(0.02 * std::sin(t), 0.0, 0.0); }));
    glm::dvec3 before = hand.position_m(0ms);
    double fastest_m_s = 0.0;
    for (Instant now{0}; now < 12s; now += 1ms) {
        if (now == 2s) hand.hold(now, {0.0, 0.03, 0.0});
        if (now == 2200ms) hand.follow(now);
        if (now == 4s) hand.home(now);
        if (now == 8s) hand.hold(now, {0.0, 0.0, 0.01});
        const glm::dvec3 place = hand.position_m(now);
        fastest_m_s = std::max(fastest_m_s, glm::distance(place, before) * 1000.0);
        before = place;
    }
    EXPECT_LT(fastest_m_s, 0.5);
    EXPECT_LT(glm::distance(before, {0.0, 0.0, 0.01}), 1e-9);
}

TEST(SteeredMotion, HomesByGoingAllTheWayOutAndThenAllTheWayIn) {
    SteeredMotion hand(still({0.01, 0.0, 0.0}));
    hand.home(1s);
    EXPECT_TRUE(hand.homing(1500ms));
    EXPECT_GE(hand.position_m(1900ms).z, 0.053);
    EXPECT_LE(hand.position_m(3s).z, -0.060);
    EXPECT_FALSE(hand.homing(4s));
    EXPECT_LT(glm::distance(hand.position_m(5s), {0.01, 0.0, 0.0}), 1e-9);
}

}  // namespace
}  // namespace eddy::redir
