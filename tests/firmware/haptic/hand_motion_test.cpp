#include "firmware/haptic/hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace eddy {
namespace {

Instant ms(double t) {
    return Instant(std::llround(t * 1e6));
}

TEST(HandMotion, ConvergesToASteadyVelocity) {
    HandMotion hand;
    for (int i = 0; i <= 200; ++i)
        hand.take({.position_m = 1e-3 * i * glm::dvec3(0.1, -0.2, 0.3), .taken_at = ms(i)});
    EXPECT_NEAR(glm::length(hand.velocity_m_s() - glm::dvec3(0.1, -0.2, 0.3)), 0.0, 1e-12);
}

TEST(HandMotion, LagsASteadyAccelerationByItsStatedDelay) {
    HandMotion hand;
    const double a = 2.0;  // [m/s2]
    for (int i = 0; i <= 300; ++i) {
        const double t = 1e-3 * i;
        hand.take({.position_m = {0.5 * a * t * t, 0.0, 0.0}, .taken_at = ms(i)});
    }
    EXPECT_NEAR(0.3 - hand.velocity_m_s().x / a, kVelocityDelay.count(), 1e-5);
}

TEST(HandMotion, OneEncoderCountMovesTheVelocityByLessThan15MillimetresASecond) {
    HandMotion hand;
    hand.take({.position_m = glm::dvec3(0.0), .taken_at = ms(0)});
    hand.take({.position_m = {63.5e-6, 0.0, 0.0}, .taken_at = ms(1)});
    EXPECT_LT(hand.velocity_m_s().x, 0.015);
    EXPECT_GT(hand.velocity_m_s().x, 0.010);
}

TEST(HandMotion, BunchedRepliesDoNotLookLikeAFastHand) {
    HandMotion even, bunched;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 p(0.1e-3 * i, 0.0, 0.0);  // 0.1 m/s
        const double late = i % 2 == 0 ? 0.99 : 0.0;
        even.take({.position_m = p, .taken_at = ms(i)});
        bunched.take({.position_m = p, .taken_at = ms(i + late)});
        EXPECT_NEAR(bunched.velocity_m_s().x, even.velocity_m_s().x, 0.03);  // a naive difference: 10 m/s
    }
}

TEST(HandMotion, ReadingsOfTheSameInstantLeaveTheVelocity) {
    HandMotion hand;
    hand.take({.position_m = glm::dvec3(0.0), .taken_at = ms(5)});
    hand.take({.position_m = glm::dvec3(0.01), .taken_at = ms(5)});
    EXPECT_EQ(hand.velocity_m_s(), glm::dvec3(0.0));
    EXPECT_EQ(hand.position_m(), glm::dvec3(0.01));
}

TEST(HandMotion, RefusesWhatIsNotFiniteAndKeepsWhatItHad) {
    HandMotion hand;
    EXPECT_FALSE(hand.take({.position_m = glm::dvec3(std::nan("")), .taken_at = ms(0)}));
    EXPECT_EQ(hand.position_m(), glm::dvec3(0.0));
    hand.take({.position_m = glm::dvec3(0.0), .taken_at = ms(0)});
    hand.take({.position_m = glm::dvec3(1e-4), .taken_at = ms(1)});
    const glm::dvec3 p = hand.position_m(), v = hand.velocity_m_s();
    const double huge = std::numeric_limits<double>::max();
    EXPECT_FALSE(hand.take({.position_m = glm::dvec3(std::nan("")), .taken_at = ms(2)}));
    EXPECT_FALSE(hand.take({.position_m = glm::dvec3(huge), .taken_at = ms(2)}));
    EXPECT_EQ(hand.position_m(), p);
    EXPECT_EQ(hand.velocity_m_s(), v);
}

TEST(HandMotion, StartsAfreshAfterForgetting) {
    HandMotion hand;
    hand.take({.position_m = glm::dvec3(0.0), .taken_at = ms(0)});
    hand.take({.position_m = glm::dvec3(1e-4), .taken_at = ms(1)});
    hand.forget();
    EXPECT_EQ(hand.velocity_m_s(), glm::dvec3(0.0));
    hand.take({.position_m = glm::dvec3(0.04), .taken_at = ms(2)});
    EXPECT_EQ(hand.velocity_m_s(), glm::dvec3(0.0));
}

}  // namespace
}  // namespace eddy
