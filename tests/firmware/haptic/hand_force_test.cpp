#include "firmware/haptic/hand_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "firmware/haptic/soft_wall.h"
#include "firmware/haptic/stability_limits.h"

namespace eddy {
namespace {

using std::chrono::milliseconds;

constexpr double kDragNsM = 2.0, kAddedKg = 0.04;  // at the handle

/// A hand on a circle in a fluid of known drag and added mass, whose answers are a period late; one law.
struct Stirred {
    HandForce force;
    int period_ms = 20;
    double radius_m = 0.02;
    glm::dvec3 push_n{0.0};
    HapticOrders orders{.enabled = true, .gain = 10.0, .tank_from_device = {.scale = 1.25}};

    std::uint64_t sequence = 0;
    FluidSnapshot answer{}, under_way{};
    glm::dvec3 body_m{0.0}, velocity_m_s{0.0};
    double received_j = 0.0;

    explicit Stirred(ForceLaw law) : force(law, {}) {}

    glm::dvec3 at(double t) const {
        const double w = 2.0 * std::numbers::pi;
        return radius_m * glm::dvec3(std::cos(w * t), std::sin(w * t), 0.0);
    }
    glm::dvec3 exact_n(double t) const {
        const double w = 2.0 * std::numbers::pi;
        const glm::dvec3 v = radius_m * w * glm::dvec3(-std::sin(w * t), std::cos(w * t), 0.0);
        return push_n - kDragNsM * v + kAddedKg * w * w * at(t);
    }
    glm::dvec3 tick(int ms) {
        const double t = 1e-3 * ms, scale = orders.tank_from_device.scale, dt = 1e-3 * period_ms;
        const bool fresh = ms % period_ms == 0;
        if (fresh) {
            answer = under_way;
            const glm::dvec3 velocity = (scale * at(t) - body_m) / dt,
                             acceleration = (velocity - velocity_m_s) / dt;
            const glm::dvec3 force_n =
                (push_n - (kDragNsM * velocity + kAddedKg * acceleration) / scale) / orders.gain;
            received_j -= glm::dot(force_n, 0.5 * (velocity + velocity_m_s)) * dt;
            under_way = {.force_n = force_n,
                         .sequence = ++sequence,
                         .computed_for = milliseconds(ms),
                         .fluid_period = Seconds(dt),
                         .velocity_m_s = velocity,
                         .acceleration_m_s2 = acceleration,
                         .received_j = received_j};
            body_m = scale * at(t);
            velocity_m_s = velocity;
        }
        return force(
            answer, fresh, orders,
            {.now = milliseconds(ms), .known = true, .moved_at = milliseconds(ms), .body_m = scale * at(t)},
            Seconds(1e-3));
    }
    /// rms of (force - exact) / rms of exact, over the last of so many seconds.
    double error(int seconds) {
        double off = 0.0, all = 0.0;
        for (int ms = 0; ms < 1000 * seconds; ++ms) {
            const glm::dvec3 f = tick(ms), exact = exact_n(1e-3 * ms);
            if (ms < 1000 * (seconds - 1)) continue;
            off += glm::dot(f - exact, f - exact);
            all += glm::dot(exact, exact);
        }
        return std::sqrt(off / all);
    }
};

TEST(HandForce, ModelBringsTheForceOfNowWhereTheFilterIsAQuarterBehind) {
    Stirred model(ForceLaw::Model), filter(ForceLaw::Filter);
    EXPECT_LT(model.error(5), 0.1);  // 10 ms: the tracker's
    EXPECT_GT(filter.error(5),
              0.25);  // 20 ms late, half of 20 held, 10 of the step's own, 13 of the filter: 0.33 rad
}

TEST(HandForce, WhatTheModelKnowsIsWhatTheHandleFeels) {
    Stirred model(ForceLaw::Model);
    model.error(5);
    EXPECT_NEAR(model.force.report().drag_ns_m, kDragNsM, 0.02);
    EXPECT_NEAR(model.force.report().added_kg, kAddedKg, 0.001);
    EXPECT_GT(model.force.report().explained, 0.99);
}

TEST(HandForce, ASteadyPullPassesTheModelWhole) {
    Stirred model(ForceLaw::Model);
    model.radius_m = 0.0;
    model.push_n = {0.6, -0.5, 0.0};
    EXPECT_LT(model.error(4), 0.02);
    model = Stirred(ForceLaw::Model);
    model.push_n = {0.6, -0.5, 0.0};
    EXPECT_LT(model.error(6), 0.03);  // stirring in it
}

TEST(HandForce, WhereNothingIsKnownItIsTheFilterExactly) {
    Stirred model(ForceLaw::Model), filter(ForceLaw::Filter);
    model.radius_m = filter.radius_m = 0.0;
    model.push_n = filter.push_n = {0.3, 0.0, 0.0};
    for (int ms = 0; ms < 500; ++ms) EXPECT_EQ(model.tick(ms), filter.tick(ms));
}

TEST(HandForce, SlopesInUseAreWithinWhatTheHandBearsWhateverTheGainBecomes) {
    Stirred model(ForceLaw::Model);
    model.error(3);
    ASSERT_NEAR(model.force.report().drag_ns_m, kDragNsM, 0.02);
    model.orders.gain *= 50.0;
    for (int ms = 3000; ms < 3200; ++ms) {
        model.tick(ms);
        ASSERT_LE(model.force.report().drag_ns_m, most_drag_ns_m(Seconds(0.02)) * (1.0 + 1e-12)) << ms;
        ASSERT_LE(model.force.report().added_kg, kMostAddedKg * (1.0 + 1e-12)) << ms;
    }
}

TEST(HandForce, GentleStirringIsNotDampedOnceItIsKnown) {
    Stirred model(ForceLaw::Model);
    std::uint64_t learning = 0;
    for (int ms = 0; ms < 5000; ++ms) {
        model.tick(ms);
        if (ms == 1000) learning = model.force.report().damped;
    }
    EXPECT_EQ(model.force.report().damped, learning);
}

TEST(SoftWall, PushesBackInAndIsNoForceInside) {
    const HapticOrders orders{.tank_from_device = {.centre_m = glm::dvec3(0.1), .scale = 2.0},
                              .lowest_m = glm::dvec3(0.02),
                              .highest_m = glm::dvec3(0.18)};
    EXPECT_EQ(soft_wall_n(orders, glm::dvec3(0.039), glm::dvec3(0.5)), glm::dvec3(0.0));
    // 10 mm of handle beyond the bound, at rest; going in; coming out.
    EXPECT_NEAR(soft_wall_n(orders, {0.05, 0.0, 0.0}, {}).x, -1.2, 1e-12);
    EXPECT_NEAR(soft_wall_n(orders, {0.05, 0.0, 0.0}, {0.5, 0.0, 0.0}).x, -1.3, 1e-12);
    EXPECT_NEAR(soft_wall_n(orders, {0.05, 0.0, 0.0}, {-0.5, 0.0, 0.0}).x, -1.2, 1e-12);
}

TEST(SoftWall, AHandleThrownAtItSettlesThough2msLate) {
    // The lightest handle with the least damping (0.15 kg, 0.5 N s/m), 0.5 m/s, the force held for a tick and two ticks late.
    const HapticOrders orders{.lowest_m = glm::dvec3(-0.04), .highest_m = glm::dvec3(0.04)};
    glm::dvec3 x{0.04, 0.0, 0.0}, v{0.5, 0.0, 0.0}, late[3]{};
    double peak = 0.0, rebound = 0.0;
    for (int i = 0; i < 1000; ++i) {
        late[i % 3] = soft_wall_n(orders, x, v);
        v += 1e-3 / 0.15 * (late[(i + 1) % 3] - 0.5 * v);
        x += 1e-3 * v;
        peak = std::max(peak, x.x);
        rebound = std::max(rebound, -v.x);
    }
    EXPECT_LT(peak, 0.06);     // 20 mm into it
    EXPECT_LT(rebound, 0.45);  // slower than it came
}

}  // namespace
}  // namespace eddy
