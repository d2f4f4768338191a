#include "firmware/haptic/hand_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace eddy {
namespace {

using std::chrono::milliseconds;

constexpr double kW = 2.0 * std::numbers::pi;
constexpr double kFastest = 3.0;  // [m/s]

PoseSnapshot pose_at(int ms) {
    const double angle = kW * 1e-3 * ms;
    return {.position_m = 0.02 * glm::dvec3(std::cos(angle), std::sin(angle), 0.0),
            .time = milliseconds(ms),
            .known = true};
}

/// How wrong accelerations from the path are, at 75 updates a second that fall between ticks, as a share of the true one.
double worst_acceleration_error(bool as_it_is) {
    const double period_s = 1.0 / 75.0;
    HandPath path;
    glm::dvec3 before_m(0.0), velocity_m_s(0.0);
    double worst = 0.0;
    for (int n = 0; n < 75; ++n) {
        const double t = n * period_s;
        const auto now = std::chrono::duration_cast<Instant>(Seconds(t));
        const PoseSnapshot pose = pose_at(static_cast<int>(1e3 * t));
        const glm::dvec3 here_m = as_it_is ? pose.position_m : path.at(pose, now, kFastest);
        const glm::dvec3 velocity = (here_m - before_m) / period_s,
                         acceleration = (velocity - velocity_m_s) / period_s;
        // Of the middle of the two steps.
        const double middle = kW * (t - period_s);
        const glm::dvec3 exact = -0.02 * kW * kW * glm::dvec3(std::cos(middle), std::sin(middle), 0.0);
        if (n > 3) worst = std::max(worst, glm::length(acceleration - exact) / glm::length(exact));
        before_m = here_m;
        velocity_m_s = velocity;
    }
    return worst;
}

TEST(HandPath, GivesTheAccelerationOfAHandThatStirsWhateverTheTicksPhase) {
    EXPECT_LT(worst_acceleration_error(false), 0.05);
    EXPECT_GT(worst_acceleration_error(true), 0.5);
}

TEST(HandPath, TheFirstPoseAndOneThatIsNotKnownAreWhereTheyAre) {
    HandPath path;
    EXPECT_EQ(path.at(pose_at(100), milliseconds(101), kFastest), pose_at(100).position_m);
    PoseSnapshot lost = pose_at(120);
    lost.known = false;
    EXPECT_EQ(path.at(lost, milliseconds(121), kFastest), lost.position_m);
    EXPECT_EQ(path.at(pose_at(140), milliseconds(141), kFastest), pose_at(140).position_m);
    EXPECT_NE(path.at(pose_at(160), milliseconds(161), kFastest), pose_at(160).position_m);
    path.forget();
    EXPECT_EQ(path.at(pose_at(180), milliseconds(181), kFastest), pose_at(180).position_m);
}

TEST(HandPath, ALoopThatIsHeldUpCarriesTheHandNoFurtherThanTwoTicks) {
    HandPath path;
    path.at(pose_at(100), milliseconds(100), kFastest);
    const PoseSnapshot stuck = pose_at(120);
    EXPECT_LT(glm::distance(path.at(stuck, milliseconds(500), kFastest), stuck.position_m),
              0.0026 * kW * 0.02);
}

TEST(HandPath, ALeapIsNoMovement) {
    HandPath path;
    path.at(pose_at(100), milliseconds(100), kFastest);
    PoseSnapshot leapt = pose_at(120);
    leapt.position_m.x += 0.1;  // 5 m/s
    EXPECT_EQ(path.at(leapt, milliseconds(121), kFastest), leapt.position_m);
}

}  // namespace
}  // namespace eddy
