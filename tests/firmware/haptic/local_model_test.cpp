#include "firmware/haptic/local_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "firmware/haptic/stability_limits.h"

namespace eddy {
namespace {

constexpr SlopeBounds kWide{20.0, 1.0};

/// A fluid that is a known drag, a known added mass and a steady push, seen at a rate; the body goes on a path.
struct KnownFluid {
    double drag_ns_m = 3.0, added_kg = 0.1;
    glm::dvec3 push_n{0.0};
    double period_s = 0.02;
    std::function<glm::dvec3(double)> at_m = [](double t) {
        const double w = 2.0 * std::numbers::pi;
        return 0.02 * glm::dvec3(std::cos(w * t), std::sin(w * t), 0.0);
    };

    /// The answer to the n-th step: velocity is the displacement of the step, as a fluid is told it.
    FluidAnswer answer(int n) const {
        const auto velocity = [this](int k) {
            return (at_m(k * period_s) - at_m((k - 1) * period_s)) / period_s;
        };
        FluidAnswer a{.velocity_m_s = velocity(n),
                      .acceleration_m_s2 = (velocity(n) - velocity(n - 1)) / period_s};
        a.force_n = push_n - drag_ns_m * a.velocity_m_s - added_kg * a.acceleration_m_s2;
        return a;
    }
    LocalModel learnt(double seconds, const SlopeBounds& bounds = kWide) const {
        LocalModel model;
        for (int n = 1; n * period_s < seconds; ++n) {
            model.learn(answer(n), Seconds(period_s), bounds);
            model.follow(Seconds(period_s), bounds);
        }
        return model;
    }
};

TEST(LocalModel, FindsAKnownDragAndAddedMassAtAnyRate) {
    for (const double rate_hz : {20.0, 30.0, 50.0, 75.0}) {
        KnownFluid fluid;
        fluid.period_s = 1.0 / rate_hz;
        const LocalModel model = fluid.learnt(4.0);
        EXPECT_NEAR(model.drag_ns_m(), 3.0, 0.01) << rate_hz;
        EXPECT_NEAR(model.added_kg(), 0.1, 0.001) << rate_hz;
        EXPECT_GT(model.explained(), 0.999);
    }
}

TEST(LocalModel, ASteadyJetIsNoSlope) {
    KnownFluid fluid;
    fluid.push_n = {5.0, -3.0, 0.0};
    const LocalModel model = fluid.learnt(4.0);
    EXPECT_NEAR(model.drag_ns_m(), 3.0, 0.01);
    EXPECT_NEAR(model.added_kg(), 0.1, 0.001);
}

TEST(LocalModel, WithTheFluidAddsUpToTheForceOfNow) {
    // A fluid at 30 Hz, a frame late: what it does not explain and what it makes of the motion of now are the force of now.
    KnownFluid fluid;
    fluid.push_n = {0.0, 0.4, 0.0};
    fluid.period_s = 1.0 / 30.0;
    const LocalModel model = fluid.learnt(4.0);
    const double w = 2.0 * std::numbers::pi, now = 4.05;
    const FluidAnswer late = fluid.answer(static_cast<int>(now / fluid.period_s) - 1);
    const glm::dvec3 v = 0.02 * w * glm::dvec3(-std::sin(w * now), std::cos(w * now), 0.0),
                     a = -w * w * fluid.at_m(now);
    const glm::dvec3 predicted =
        late.force_n - model.force_n(late.velocity_m_s, late.acceleration_m_s2) + model.force_n(v, a);
    const glm::dvec3 exact = fluid.push_n - 3.0 * v - 0.1 * a;
    EXPECT_LT(glm::length(predicted - exact), 0.005 * glm::length(exact));
    EXPECT_GT(glm::length(late.force_n - exact), 0.2 * glm::length(exact));  // the hold alone
}

TEST(LocalModel, SlopesAreNeverNegative) {
    for (const auto& [drag, added] : {std::pair(-2.0, 0.1), {2.0, -0.1}, {-2.0, -0.1}}) {
        KnownFluid fluid;
        fluid.drag_ns_m = drag;
        fluid.added_kg = added;
        const LocalModel model = fluid.learnt(4.0);
        // What a slope of 0 leaves over counts as scatter, and makes the other less sure.
        EXPECT_NEAR(model.drag_ns_m(), std::max(0.0, drag), 0.5);
        EXPECT_NEAR(model.added_kg(), std::max(0.0, added), 0.03);
        EXPECT_EQ(model.drag_ns_m() == 0.0, drag < 0.0);
        EXPECT_EQ(model.added_kg() == 0.0, added < 0.0);
    }
}

TEST(LocalModel, SlopesStayWithinTheirBounds) {
    const LocalModel model = KnownFluid{}.learnt(4.0, {1.5, 0.02});
    EXPECT_LE(model.drag_ns_m(), 1.5);
    EXPECT_GT(model.drag_ns_m(), 1.4);
    EXPECT_LE(model.added_kg(), 0.02);
    EXPECT_GT(model.added_kg(), 0.018);
}

TEST(LocalModel, WithoutMotionNothingIsKnown) {
    KnownFluid fluid;
    fluid.push_n = {1.0, 0.0, 0.0};
    fluid.at_m = [](double) { return glm::dvec3(0.0); };
    const LocalModel model = fluid.learnt(4.0);
    EXPECT_EQ(model.drag_ns_m(), 0.0);
    EXPECT_EQ(model.added_kg(), 0.0);
}

TEST(LocalModel, WhatWasKnownIsForgottenWhenForcesScatterInstead) {
    KnownFluid fluid;
    LocalModel model = fluid.learnt(3.0);
    ASSERT_NEAR(model.drag_ns_m(), 3.0, 0.01);
    for (int n = 0; n < 500; ++n) {  // 10 s at rest in a stream that flutters
        model.learn({.force_n = {std::sin(1.7 * n), std::cos(2.3 * n), 0.0}}, Seconds(0.02), kWide);
        model.follow(Seconds(0.02), kWide);
    }
    EXPECT_LT(model.drag_ns_m(), 0.15);
    EXPECT_LT(model.added_kg(), 0.005);
}

TEST(LocalModel, ScatterThatHasNothingToDoWithTheMotionGivesNoSlope) {
    LocalModel model;
    double most = 0.0;
    for (int n = 0; n < 500; ++n) {
        const double w = 2.0 * std::numbers::pi * 0.02;
        model.learn({.force_n = {std::sin(1.7 * n), std::cos(2.3 * n), std::sin(2.9 * n)},
                     .velocity_m_s = 0.01 * glm::dvec3(std::cos(w * n), std::sin(w * n), 0.0),
                     .acceleration_m_s2 = 0.06 * glm::dvec3(-std::sin(w * n), std::cos(w * n), 0.0)},
                    Seconds(0.02), kWide);
        model.follow(Seconds(0.02), kWide);
        most = std::max(most, model.drag_ns_m());
    }
    EXPECT_LT(most, 5.0);  // least squares without a prior go to several times kWide
    EXPECT_LT(model.explained(), 0.2);
}

TEST(LocalModel, AnAnswerThatIsNotFiniteIsNotLearnt) {
    LocalModel model = KnownFluid{}.learnt(3.0);
    const double drag = model.drag_ns_m();
    model.learn({.force_n = glm::dvec3(std::nan(""))}, Seconds(0.02), kWide);
    model.follow(Seconds(0.02), kWide);
    EXPECT_NEAR(model.drag_ns_m(), drag, 0.01);
}

/// A mass in a drag that comes one period late and is held for the next.
double speed_after(double mass_kg, double drag_ns_m, double period_s, int periods) {
    double v = 1.0, before = 1.0;
    for (int n = 0; n < periods; ++n) {
        const double next = v - drag_ns_m * period_s / mass_kg * before;
        before = v;
        v = next;
    }
    return std::abs(v) + std::abs(before);
}

TEST(StabilityLimits, ADragTwiceAsSteepAsUsedIsWhereALateFluidBeginsToDriveTheHandle) {
    for (const double period_s : {1.0 / 20.0, 1.0 / 30.0, 1.0 / 50.0}) {
        const double limit = most_drag_ns_m(Seconds(period_s)) / kStabilityShare;
        EXPECT_LT(speed_after(kHandleMassKg, 0.99 * limit, period_s, 3000), 1e-3);
        EXPECT_GT(speed_after(kHandleMassKg, 1.01 * limit, period_s, 3000), 1e3);
    }
}

}  // namespace
}  // namespace eddy
