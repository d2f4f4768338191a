#include "firmware/force_ripple.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace eddy {
namespace {

using Force = std::function<glm::dvec3(double)>;

constexpr double kPi = std::numbers::pi;

/// What is said of a force of time [s], told `rate` times a second for `seconds` from `start` on.
std::optional<ForceRipple::Figures> ripple_of(const Force& force, double rate, double seconds,
                                              double start = 0.0) {
    ForceRipple ripple;
    for (int i = 0; i <= std::lround(seconds * rate); ++i)
        ripple.add(Seconds(start + i / rate), force(start + i / rate));
    return ripple.figures();
}

Force sine(double frequency, const glm::dvec3& amplitude, const glm::dvec3& mean) {
    return [=](double t) { return mean + amplitude * std::sin(2.0 * kPi * frequency * t); };
}

TEST(ForceRipple, OfASineFarAboveFiveHertzIsItsAmplitudeOverRootTwo) {
    // Of frequencies whose periods fill the mean's 0.2 s the mean is 0, and two seconds hold whole periods.
    const glm::dvec3 amplitude(0.03, -0.04, 0.0), mean(0.0, 0.0, 2.0);
    for (const double frequency : {20.0, 50.0, 100.0}) {
        const auto ripple = ripple_of(sine(frequency, amplitude, mean), 1000.0, 3.0);
        ASSERT_TRUE(ripple);
        EXPECT_NEAR(ripple->rms, 0.05 / std::numbers::sqrt2, 1e-3 * 0.05) << frequency;
        EXPECT_NEAR(ripple->share, 0.025 / std::numbers::sqrt2, 1e-3 * 0.025) << frequency;
    }
}

TEST(ForceRipple, OfASlowSineIsWhatItsMeanDiffersBy) {
    // A mean over w leaves 1 - sin(pi f w) / (pi f w) of a sine; of a hand that swings at 1 Hz, 6.5 %.
    const double x = kPi * 1.0 * 0.2;
    const auto ripple = ripple_of(sine(1.0, {1.0, 0.0, 0.0}, glm::dvec3(0.0)), 500.0, 4.0);
    ASSERT_TRUE(ripple);
    EXPECT_NEAR(ripple->rms, (1.0 - std::sin(x) / x) / std::numbers::sqrt2, 1e-4);
}

TEST(ForceRipple, OfAConstantForceOrARampIsNothing) {
    const glm::dvec3 slope(3.0, -2.0, 1.0), start(1.0, 1.0, 1.0);
    const auto constant = ripple_of([&](double) { return start; }, 100.0, 3.0);
    ASSERT_TRUE(constant);
    EXPECT_LT(constant->rms, 1e-12);
    EXPECT_LT(constant->share, 1e-12);
    const auto ramp = ripple_of([&](double t) { return start + slope * t; }, 100.0, 3.0);
    ASSERT_TRUE(ramp);
    EXPECT_LT(ramp->rms, 1e-9);
}

TEST(ForceRipple, OfNoForceIsNoShareOfIt) {
    const auto ripple = ripple_of([](double) { return glm::dvec3(0.0); }, 100.0, 3.0);
    ASSERT_TRUE(ripple);
    EXPECT_EQ(ripple->rms, 0.0);
    EXPECT_EQ(ripple->share, 0.0);
}

TEST(ForceRipple, OfARampThatComesAtUnevenTimesIsNothing) {
    std::mt19937 chance(1);
    std::uniform_real_distribution<double> interval(0.002, 0.03);
    ForceRipple ripple;
    for (double t = 100.0; t < 104.0; t += interval(chance)) ripple.add(Seconds(t), {t, -t, 0.0});
    ASSERT_TRUE(ripple.figures());
    EXPECT_LT(ripple.figures()->rms, 1e-9);
}

TEST(ForceRipple, ForgetsWhatIsOlderThanItsTwoSeconds) {
    // It trembles for a second, then rests; the mean at the rest's begin has seen the trembling for 0.1 s.
    const auto until = [&](double end) {
        return ripple_of(
            [](double t) { return glm::dvec3(t < 1.0 ? std::sin(2.0 * kPi * 25.0 * t) : 1.0, 0.0, 0.0); },
            200.0, end);
    };
    EXPECT_GT(until(2.0)->rms, 0.4);
    EXPECT_LT(until(3.4)->rms, 1e-9);
}

TEST(ForceRipple, StartsAnewWhenTimeJumps) {
    const Force trembling = sine(25.0, {1.0, 0.0, 0.0}, glm::dvec3(0.0));
    for (const double jump : {0.3, 3600.0, 0.0, -1.0}) {
        ForceRipple ripple;
        double t = 10.0;
        for (int i = 0; i < 600; ++i) {
            t = 10.0 + i * 0.005;
            ripple.add(Seconds(t), trembling(t));
        }
        ASSERT_TRUE(ripple.figures());
        EXPECT_GT(ripple.figures()->rms, 0.5);
        const double anew = t + jump;
        ripple.add(Seconds(anew), {5.0, 0.0, 0.0});
        EXPECT_FALSE(ripple.figures()) << jump;
        for (int i = 1; i < 200; ++i) ripple.add(Seconds(anew + i * 0.005), {5.0, 0.0, 0.0});
        ASSERT_TRUE(ripple.figures());
        EXPECT_LT(ripple.figures()->rms, 1e-9) << jump;  // nothing of what was before
    }
}

TEST(ForceRipple, IsUnknownAtFewerThanTwelveForcesASecond) {
    const Force force = sine(1.0, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
    EXPECT_FALSE(ripple_of(force, 9.0, 30.0));
    EXPECT_TRUE(ripple_of(force, 16.0, 30.0));
    EXPECT_FALSE(ripple_of(force, 100.0, 0.3));
    EXPECT_TRUE(ripple_of(force, 100.0, 0.5));
}

TEST(ForceRipple, KeepsItsRoomHoweverLongItRuns) {
    // Far more than it keeps, and more often than once a millisecond: the last of it counts.
    const auto ripple = ripple_of(sine(50.0, {1.0, 0.0, 0.0}, glm::dvec3(0.0)), 4000.0, 5.0);
    ASSERT_TRUE(ripple);
    EXPECT_NEAR(ripple->rms, 1.0 / std::numbers::sqrt2, 0.01);
}

}  // namespace
}  // namespace eddy
