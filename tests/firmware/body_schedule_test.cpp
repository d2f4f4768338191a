#include "firmware/body_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/input_error.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

constexpr double kDt = 0.02;

Scene scene_with(const std::string& body) {
    return read_scene("[[body]]\nradius_m = 0.01\ncentre_m = [0.08, 0.07, 0.06]\n" + body, "test.toml").scene;
}

gles::BodyState at(const Scene& scene, double t) {
    return BodySchedule(scene).at(t, kDt).at(0);
}

void expect_near(const glm::dvec3& got, const glm::dvec3& wanted, double tolerance, double t) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(got[axis], wanted[axis], tolerance) << "axis " << axis << " at " << t;
}

const glm::dvec3 kCentre(0.08, 0.07, 0.06);

TEST(BodySchedule, PrescribedBodyFollowsTheClosedForm) {
    const Scene scene = scene_with(
        "motion = \"prescribed\"\nstart_s = 0.5\nvelocity_m_s = [0.1, 0.0, -0.2]\nacceleration_m_s2 = [0.0, "
        "0.3, 0.0]\n"
        "oscillation = { amplitude_m = [0.0, 0.0, 0.01], frequency_hz = 2.0, phase_rad = 0.3 }\n");
    for (double t = 0.0; t < 2.0; t += 0.037) {
        const double s = std::max(0.0, t - 0.5);
        const glm::dvec3 wanted = kCentre + s * glm::dvec3(0.1, 0.0, -0.2) +
                                  glm::dvec3(0.0, 0.15 * s * s, 0.0) +
                                  glm::dvec3(0.0, 0.0, 0.01 * std::sin(4.0 * std::numbers::pi * s + 0.3));
        expect_near(at(scene, t).centre_m, wanted, 1e-15, t);
    }
}

TEST(BodySchedule, VelocityTimesTheStepIsTheDisplacement) {
    const Scene scene = scene_with(
        "motion = \"prescribed\"\nstart_s = 0.05\nvelocity_m_s = [0.1, 0.0, -0.2]\n"
        "oscillation = { amplitude_m = [0.02, 0.03, 0.01], frequency_hz = 3.0 }\n");
    const BodySchedule motions(scene);
    glm::dvec3 before = motions.at(0.0, kDt).at(0).centre_m;
    for (int n = 1; n < 60; ++n) {
        const gles::BodyState state = motions.at(n * kDt, kDt).at(0);
        expect_near(before + kDt * state.velocity_m_s, state.centre_m, 1e-15, n * kDt);
        before = state.centre_m;
    }
}

TEST(BodySchedule, VelocityIsTheDerivativeInTheMiddleOfTheStep) {
    const Scene scene = scene_with(
        "motion = \"prescribed\"\noscillation = { amplitude_m = [0.02, 0.0, 0.0], frequency_hz = 1.0 }\n");
    const double omega = 2.0 * std::numbers::pi;
    for (double t = kDt; t < 1.0; t += kDt)
        // Off by dt^2/24 times the third derivative at most.
        EXPECT_NEAR(at(scene, t).velocity_m_s.x, 0.02 * omega * std::cos(omega * (t - 0.5 * kDt)),
                    1.01 * kDt * kDt / 24.0 * 0.02 * omega * omega * omega);
}

TEST(BodySchedule, RestsUntilItsStart) {
    const Scene scene = scene_with(
        "motion = \"prescribed\"\nstart_s = 1.0\nvelocity_m_s = [1.0, 0.0, 0.0]\n"
        "spin_rad_s = [0.0, 3.0, 0.0]\n");
    const gles::BodyState state = at(scene, 1.0);
    EXPECT_EQ(state.centre_m, kCentre);
    EXPECT_EQ(state.velocity_m_s, glm::dvec3(0.0));
    EXPECT_EQ(state.spin_rad_s, glm::dvec3(0.0));
}

TEST(BodySchedule, SpinsAboutItsAxis) {
    const Scene scene = scene_with("motion = \"prescribed\"\nspin_rad_s = [0.0, 0.0, 2.0]\n");
    const gles::BodyState state = at(scene, 0.25 * std::numbers::pi);  // a quarter turn
    expect_near(state.spin_rad_s, {0.0, 0.0, 2.0}, 1e-9, 0.0);
    EXPECT_EQ(state.centre_m, kCentre);
    expect_near(state.orientation * glm::dvec3(1.0, 0.0, 0.0), {0.0, 1.0, 0.0}, 1e-12, 0.0);
}

TEST(BodySchedule, FixedBodyNeverMoves) {
    const Scene scene = scene_with("motion = \"fixed\"\n");
    for (const double t : {0.0, 1.0, 1e6}) {
        EXPECT_EQ(at(scene, t).centre_m, kCentre);
        EXPECT_EQ(at(scene, t).velocity_m_s, glm::dvec3(0.0));
    }
    EXPECT_FALSE(BodySchedule(scene).held());
}

TEST(BodySchedule, KnowsWhichBodyTheVisitorHolds) {
    const Scene scene = read_scene(
                            "[[body]]\nradius_m = 0.01\ncentre_m = [0.1, 0.1, 0.1]\n[[body]]\nradius_m = "
                            "0.01\nmotion = \"held\"\n",
                            "test.toml")
                            .scene;
    EXPECT_EQ(BodySchedule(scene).held(), std::size_t{1});
}

TEST(BodySchedule, PathIsAddedToTheCentreAndHeldAtItsEnd) {
    const ScratchFolder folder;
    const std::string csv =
        folder.write("path.csv", "t_s,x_m,y_m,z_m\n0,0,0,0\n1,0.01,0,0.02\n2,0.02,0,0.04\n");
    const Scene scene = scene_with("motion = \"prescribed\"\npath_csv = \"" + csv + "\"\n");
    for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0})  // a straight line is reproduced exactly
        expect_near(at(scene, t).centre_m, kCentre + t * glm::dvec3(0.01, 0.0, 0.02), 1e-12, t);
    expect_near(at(scene, 9.0).centre_m, kCentre + glm::dvec3(0.02, 0.0, 0.04), 1e-12, 9.0);
    EXPECT_EQ(at(scene, 9.0).velocity_m_s, glm::dvec3(0.0));
}

TEST(BodySchedule, PathThatIsWrongIsNamedWithItsLine) {
    const ScratchFolder folder;
    const std::string csv = folder.write("path.csv", "t_s,x_m,y_m,z_m\n0,0,0,0\n1,left,0,0\n");
    const Scene scene = scene_with("motion = \"prescribed\"\npath_csv = \"" + csv + "\"\n");
    try {
        const BodySchedule motions(scene);
        FAIL() << "a path with a word for a number was taken";
    } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()).rfind(csv + ":3:", 0), 0u) << e.what();
    }
}

}  // namespace
}  // namespace eddy
