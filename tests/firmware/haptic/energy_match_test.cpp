#include "firmware/haptic/energy_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "firmware/haptic/motion_tracker.h"

namespace eddy {
namespace {

constexpr double kModelDrag = 1.5, kModelMass = 0.07;  // [N s/m], [kg]
constexpr Seconds kMs{1e-3};

/// A hand whose model force is that of its tracker, for some seconds.
struct Matched {
    EnergyMatch::Shares shares;  ///< at the end
    double work_j = 0.0;         ///< against the model, in the last two seconds
    double unmatched_j = 0.0;    ///< the same had it been given whole
    double drag_j = 0.0;         ///< what the drag alone takes on that path

    Matched(const std::function<glm::dvec3(double)>& at_m, int ms) {
        MotionTracker tracker;
        EnergyMatch match;
        for (int i = 0; i < ms; ++i) {
            const glm::dvec3 here_m = at_m(1e-3 * i), way_m = at_m(1e-3 * (i + 1)) - here_m;
            tracker.take(here_m, std::chrono::milliseconds(i));
            const glm::dvec3 &v = tracker.velocity_m_s(), &a = tracker.acceleration_m_s2();
            match.moved_to(here_m, v, a, kMs);
            shares = match.follow(kModelDrag, kModelMass, kMs);
            if (i < ms - 2000) continue;
            work_j += glm::dot(kModelDrag * shares.drag * v + kModelMass * shares.added * a, way_m);
            unmatched_j += glm::dot(kModelDrag * v + kModelMass * a, way_m);
            drag_j += kModelDrag * glm::dot(way_m, way_m) / kMs.count();
        }
    }
};

std::function<glm::dvec3(double)> circling(double hz) {
    return [w = 2.0 * std::numbers::pi * hz](double t) {
        return 0.02 * glm::dvec3(std::cos(w * t), std::sin(w * t), 0.0);
    };
}

TEST(EnergyMatch, StirringCostsWhatTheDragTakesHoweverFast) {
    for (const double hz : {0.5, 1.0, 2.0, 5.0}) {
        const Matched hand(circling(hz), 6000);
        EXPECT_NEAR(hand.work_j / hand.drag_j, EnergyMatch::kAllowed, 0.03) << hz;
    }
}

TEST(EnergyMatch, WithoutItFastStirringWouldCostHalfAsMuchAgain) {
    EXPECT_GT(Matched(circling(2.0), 6000).unmatched_j, 1.4 * Matched(circling(2.0), 6000).drag_j);
}

TEST(EnergyMatch, NoDragIsTheLimitOfALittle) {
    const auto shares = [](double drag_ns_m) {
        MotionTracker tracker;
        EnergyMatch match;
        EnergyMatch::Shares found;
        for (int i = 0; i < 3000; ++i) {
            const glm::dvec3 here_m = circling(2.0)(1e-3 * i);
            tracker.take(here_m, std::chrono::milliseconds(i));
            match.moved_to(here_m, tracker.velocity_m_s(), tracker.acceleration_m_s2(), kMs);
            found = match.follow(drag_ns_m, kModelMass, kMs);
        }
        return found;
    };
    EXPECT_NEAR(shares(0.0).added, shares(1e-9).added, 1e-6);
    EXPECT_LT(shares(0.0).added, 0.01);
}

TEST(EnergyMatch, AHandThatGoesStraightGetsTheWholeModel) {
    const Matched hand([](double t) { return glm::dvec3(0.05 * t, 0.0, 0.0); }, 4000);
    EXPECT_GT(hand.shares.drag, 0.999);
    EXPECT_EQ(hand.shares.added, 1.0);
}

TEST(EnergyMatch, TheFlickerOfEncodersIsNoMovement) {
    const Matched hand(
        [](double t) { return glm::dvec3(std::lround(1e3 * t) % 7 < 3 ? 63.5e-6 : 0.0, 0.0, 0.0); }, 4000);
    EXPECT_GT(hand.shares.drag, 0.95);
}

TEST(EnergyMatch, AfterFastStirringTheDragIsBackInASecond) {
    const Matched hand(
        [circle = circling(5.0)](double t) {
            return t < 3.0 ? circle(t) : circle(3.0) + glm::dvec3(0.1 * (t - 3.0), 0.0, 0.0);
        },
        5000);
    EXPECT_GT(hand.shares.drag, 0.9);
}

}  // namespace
}  // namespace eddy
