#include "gles/fluid/step_guard.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gles/body/bounds.h"

namespace eddy::gles {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInf = std::numeric_limits<double>::infinity();

/// 0.16 m a side, a ball of 2 cm in it.
FluidSetup tank() {
    FluidSetup s;
    s.cells = glm::ivec3(16);
    s.cell_m = 0.01;
    s.shortest_step_s = 2e-5;
    s.longest_step_s = 0.1;
    s.bodies = {BodySetup{Sphere{0.02}}};
    return s;
}

const BodyState kBefore{.centre_m = {0.05, 0.06, 0.07}, .velocity_m_s = {0.1, 0.0, 0.0}};

struct Guarded {
    BodyState body;
    GuardCounts counts;
};
Guarded guarded(const BodyState& given, const FluidSetup& setup = tank()) {
    Guarded g;
    g.body = guarded_bodies({given}, {kBefore}, setup, 0.02, g.counts).at(0);
    return g;
}

TEST(StepGuard, RefusesAStepOfNoLength) {
    GuardCounts counts;
    const double none[] = {0.0, -0.02, kNan, kInf, -kInf, 1e-9, 1e-7, 1e-300};
    for (const double dt : none) EXPECT_FALSE(guarded_step_s(dt, tank(), counts)) << dt;
    EXPECT_EQ(counts.step_refused, static_cast<long>(std::size(none)));
    EXPECT_EQ(guarded_step_s(0.02, tank(), counts), 0.02);
    EXPECT_EQ(counts.step_refused, static_cast<long>(std::size(none)));
}

TEST(StepGuard, ShortensAStepToTheLongest) {
    GuardCounts counts;
    EXPECT_EQ(guarded_step_s(0.25, tank(), counts), 0.1);
    EXPECT_EQ(guarded_step_s(1e30, tank(), counts), 0.1);
    EXPECT_EQ(counts.step_shortened, 2);
    EXPECT_EQ(guarded_step_s(0.1, tank(), counts), 0.1);
    EXPECT_EQ(counts.step_shortened, 2);
}

TEST(StepGuard, LeavesASoundBodyAsItIsToTheLastBit) {
    const BodyState given{.centre_m = {0.1, -0.01, 0.2},
                          .orientation = glm::normalize(glm::dquat(0.3, 0.4, -0.5, 0.6)),
                          .velocity_m_s = {1.0, -2.0, 3.0},
                          .spin_rad_s = {-30.0, 20.0, 10.0}};
    const Guarded g = guarded(given);
    EXPECT_EQ(g.body.centre_m, given.centre_m);
    EXPECT_EQ(g.body.orientation, given.orientation);
    EXPECT_EQ(g.body.velocity_m_s, given.velocity_m_s);
    EXPECT_EQ(g.body.spin_rad_s, given.spin_rad_s);
    EXPECT_EQ(g.counts.body_not_finite + g.counts.body_not_unit + g.counts.body_far + g.counts.body_too_fast,
              0);
}

TEST(StepGuard, ABodyThatIsNotFiniteStaysWhereItWasAtRest) {
    for (const double bad : {kNan, kInf, -kInf})
        for (int what = 0; what < 4; ++what) {
            BodyState given = kBefore;
            (what == 0   ? given.centre_m.y
             : what == 1 ? given.velocity_m_s.z
             : what == 2 ? given.spin_rad_s.x
                         : given.orientation.w) = bad;
            const Guarded g = guarded(given);
            EXPECT_EQ(g.body.centre_m, kBefore.centre_m);
            EXPECT_EQ(g.body.velocity_m_s, glm::dvec3(0.0));
            EXPECT_EQ(g.counts.body_not_finite, 1) << bad << " " << what;
        }
}

TEST(StepGuard, ABodyThatNeverWasAnywhereIsOutsideUntilItIs) {
    GuardCounts counts;
    const FluidSetup setup = tank();
    const BodyState body = guarded_bodies({{.centre_m = glm::dvec3(kNan)}}, {}, setup, 0.02, counts).at(0);
    EXPECT_TRUE(is_finite(body));
    EXPECT_TRUE(body_box(setup.bodies[0], body, setup.cell_m, setup.cells).empty());
}

TEST(StepGuard, OrientationsAreOfUnitLength) {
    for (const double length : {0.1, 10.0, 1e-200, 1e200, 1.001}) {
        BodyState given = kBefore;
        given.orientation = length * glm::normalize(glm::dquat(0.3, 0.4, -0.5, 0.6));
        const Guarded g = guarded(given);
        EXPECT_NEAR(glm::length(g.body.orientation), 1.0, 1e-12) << length;
        EXPECT_NEAR(g.body.orientation.w * length, given.orientation.w, 1e-12 * length);
        EXPECT_EQ(g.counts.body_not_unit, 1);
    }
    BodyState none = kBefore;
    none.orientation = {0.0, 0.0, 0.0, 0.0};
    EXPECT_EQ(guarded(none).body.orientation, glm::dquat(1.0, 0.0, 0.0, 0.0));
}

TEST(StepGuard, ABodyFarOutsideIsDrawnInButDoesNotTouchTheTank) {
    const FluidSetup setup = tank();
    for (const double away : {1.0, 1e9, 1e300})
        for (const double side : {-1.0, 1.0}) {
            BodyState given = kBefore;
            given.centre_m.x = side * away;
            const Guarded g = guarded(given);
            EXPECT_EQ(g.counts.body_far, 1);
            EXPECT_LT(std::abs(g.body.centre_m.x - 0.08), 0.08 + 0.1 + 1e-12) << away;
            EXPECT_TRUE(body_box(setup.bodies[0], g.body, setup.cell_m, setup.cells).empty());
            EXPECT_EQ(g.body.centre_m.y, kBefore.centre_m.y);
        }
    BodyState beside = kBefore;
    beside.centre_m.x = -0.06;  // its own size outside
    EXPECT_EQ(guarded(beside).counts.body_far, 0);
}

TEST(StepGuard, NothingMovesFurtherThanTheTankInAStep) {
    BodyState given = kBefore;
    given.velocity_m_s = {3e5, 4e5, 0.0};
    given.spin_rad_s = {0.0, 0.0, 1e9};
    const Guarded g = guarded(given);
    EXPECT_NEAR(glm::length(g.body.velocity_m_s), 0.16 / 0.02, 1e-9);
    EXPECT_NEAR(g.body.velocity_m_s.x / g.body.velocity_m_s.y, 0.75, 1e-12);
    EXPECT_NEAR(g.body.spin_rad_s.z * 0.02, 0.16 / 0.02, 1e-9);
    EXPECT_EQ(g.counts.body_too_fast, 1);
    given.velocity_m_s = glm::dvec3(1e300);
    EXPECT_NEAR(glm::length(guarded(given).body.velocity_m_s), 0.16 / 0.02, 1e-9);
}

TEST(StepGuard, WhatIsSoundFollowsTheTankAndTheStep) {
    const FluidSetup setup = tank();
    EXPECT_FLOAT_EQ(sound(setup, 0.02).fastest_m_s, 80.0f);
    EXPECT_FLOAT_EQ(sound(setup, 0.01).fastest_m_s, 160.0f);
    EXPECT_TRUE(std::isfinite(sound(setup, 1e-300).fastest_m_s));
    EXPECT_TRUE(std::isfinite(sound(setup, 1e-300).most_phi));
    FluidSetup heavy = setup;
    heavy.gravity_m_s2 = {0.0, -9.81e6, 0.0};
    // A column at rest has dt g y / h.
    EXPECT_GT(sound(heavy, 0.1).most_phi, 0.1 * 9.81e6 * 16.0);
}

}  // namespace
}  // namespace eddy::gles
