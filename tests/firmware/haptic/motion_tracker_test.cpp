#include "firmware/haptic/motion_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

namespace eddy {
namespace {

using std::chrono::milliseconds;

/// A tracker that has seen so much of a path along x at 1 kHz, and rounded to counts if a count is not 0.
MotionTracker tracked(const std::function<double(double)>& x_m, int ms, double count_m = 0.0) {
    MotionTracker tracker;
    for (int i = 0; i <= ms; ++i) {
        const double x = x_m(1e-3 * i);
        tracker.take({count_m > 0.0 ? count_m * std::round(x / count_m) : x, 0.0, 0.0}, milliseconds(i));
    }
    return tracker;
}

TEST(MotionTracker, FollowsASteadyAccelerationWithoutLag) {
    const MotionTracker tracker = tracked([](double t) { return 0.1 + 0.2 * t + 0.5 * 3.0 * t * t; }, 1000);
    EXPECT_NEAR(tracker.velocity_m_s().x, 0.2 + 3.0 * 1.0, 1e-6);
    EXPECT_NEAR(tracker.acceleration_m_s2().x, 3.0, 1e-6);
}

TEST(MotionTracker, IsBehindAStirringHandAsItsThreePolesSay) {
    const double w = 2.0 * std::numbers::pi, pole = MotionTracker::kCalm_1_s;  // 1 Hz
    const MotionTracker tracker = tracked([w](double t) { return 0.02 * std::sin(w * t); }, 4100);
    const std::complex<double> s(0.0, w), three = std::pow(s + pole, 3), now = std::polar(0.02, w * 4.1);
    // Of x = Im(now): v = s (3 p2 s + p3) / (s + p)3 x,  a = s2 p3 / (s + p)3 x.
    const double v = (now * s * (3.0 * pole * pole * s + pole * pole * pole) / three).imag();
    const double a = (now * s * s * pole * pole * pole / three).imag();
    EXPECT_NEAR(tracker.velocity_m_s().x, v, 0.01 * 0.02 * w);
    EXPECT_NEAR(tracker.acceleration_m_s2().x, a, 0.01 * 0.02 * w * w);
    EXPECT_NEAR(v, 0.02 * w * std::cos(w * 4.1), 0.08 * 0.02 * w);  // and that is not far
}

TEST(MotionTracker, AHandThatSetsOffIsFollowedAtOnce) {
    MotionTracker tracker;
    int half_ms = 0;
    for (int i = -100; i < 100 && half_ms == 0; ++i) {
        tracker.take({0.1 * std::max(0.0, 1e-3 * i), 0.0, 0.0}, milliseconds(1000 + i));
        if (tracker.velocity_m_s().x >= 0.05) half_ms = i;
    }
    EXPECT_LE(half_ms, 16);  // with the calm poles alone 21
}

TEST(MotionTracker, EncoderCountsHardlyShowInTheVelocity) {
    const double count_m = 63.5e-6;  // Falcon spec sheet: 400 dpi
    double sum = 0.0;
    MotionTracker tracker;
    for (int i = 0; i < 3000; ++i) {
        const double x = 0.05e-3 * i;  // 0.05 m/s
        tracker.take({count_m * std::round(x / count_m), 0.0, 0.0}, milliseconds(i));
        if (i >= 1000) sum += std::pow(tracker.velocity_m_s().x - 0.05, 2);
    }
    EXPECT_LT(std::sqrt(sum / 2000.0), 1e-3);
}

TEST(MotionTracker, EncoderCountsHardlyShowInThePlaceThatAFluidDifferencesTwice) {
    const double count_m = 63.5e-6, w = 2.0 * std::numbers::pi;
    MotionTracker tracker;
    std::vector<double> read_m, near_m, true_m;
    double furthest_m = 0.0;
    for (int ms = 0; ms < 3000; ++ms) {
        const double x = 0.02 * std::sin(w * 1e-3 * ms), read = count_m * std::round(x / count_m);
        tracker.take({read, 0.0, 0.0}, milliseconds(ms));
        const double near = tracker.near({read, 0.0, 0.0}).x;
        furthest_m = std::max(furthest_m, std::abs(near - read));
        if (ms < 1000 || ms % 20 != 0) continue;  // a fluid at 50 steps a second
        read_m.push_back(read);
        near_m.push_back(near);
        true_m.push_back(x);
    }
    // What the steps add to the second difference, as a root of the mean square.
    const auto added_m = [&](const std::vector<double>& seen_m) {
        double sum = 0.0;
        for (std::size_t i = 2; i < seen_m.size(); ++i) {
            const auto second = [i](const std::vector<double>& x) {
                return x[i] - 2.0 * x[i - 1] + x[i - 2];
            };
            sum += std::pow(second(seen_m) - second(true_m), 2);
        }
        return std::sqrt(sum / static_cast<double>(seen_m.size() - 2));
    };
    EXPECT_LT(added_m(near_m), 0.5 * added_m(read_m));  // measured: 13 and 45 um
    EXPECT_LE(furthest_m, MotionTracker::kExpectedM * (1.0 + 1e-9));
}

TEST(MotionTracker, WhoRestsIsWhereHeIsRead) {
    MotionTracker tracker = tracked([](double t) { return 0.3 * std::min(t, 0.5); }, 2000);
    EXPECT_NEAR(tracker.near({0.15, 0.0, 0.0}).x, 0.15, 1e-9);
    const glm::dvec3 leapt(0.2, 0.1, 0.0);
    EXPECT_NEAR(glm::length(tracker.near(leapt) - leapt), MotionTracker::kExpectedM, 1e-12);
    tracker.forget();
    EXPECT_EQ(tracker.near(leapt), leapt);
}

TEST(MotionTracker, ALateTickChangesNothing) {
    MotionTracker every, some;
    const auto x = [](double t) { return glm::dvec3(0.2 * t + 1.5 * t * t, 0.0, 0.0); };
    for (int i = 0; i <= 400; ++i) {
        every.take(x(1e-3 * i), milliseconds(i));
        if (i % 7 != 3) some.take(x(1e-3 * i), milliseconds(i));
    }
    EXPECT_NEAR(every.velocity_m_s().x, some.velocity_m_s().x, 1e-5);
}

TEST(MotionTracker, AfterAGapItStartsAtRest) {
    MotionTracker tracker = tracked([](double t) { return 0.3 * t; }, 300);
    tracker.take({0.5, 0.0, 0.0}, milliseconds(400));
    EXPECT_EQ(tracker.velocity_m_s(), glm::dvec3(0.0));
    tracker.take({0.5, 0.0, 0.0}, milliseconds(401));
    EXPECT_EQ(tracker.velocity_m_s(), glm::dvec3(0.0));
}

}  // namespace
}  // namespace eddy
