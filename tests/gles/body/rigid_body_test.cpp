#include "gles/body/rigid_body.h"

#include <gtest/gtest.h>

#include <numbers>

namespace eddy::gles {
namespace {

constexpr double kPi = std::numbers::pi;

const Paddle kPaddle{{0.02, 0.03, 0.003}, 0.002, 0.03};  // its centre of mass lies above its centre

/// Free in space: velocity and spin such that momentum stays what it is.
BodyState drift(const RigidBody& body, BodyState state, double dt_s) {
    BodyState next = body.moved(state, dt_s);
    const Vector6 momentum = body.momentum(state, next.orientation);
    const Matrix6 mass = body.mass_matrix(next.orientation);
    // Gauss-Seidel is enough: the two velocities depend little on each other.
    Vector6 v{};
    for (int sweep = 0; sweep < 200; ++sweep)
        for (std::size_t i = 0; i < 6; ++i) {
            double rest = momentum[i];
            for (std::size_t j = 0; j < 6; ++j) rest -= j == i ? 0.0 : mass[i][j] * v[j];
            v[i] = rest / mass[i][i];
        }
    next.velocity_m_s = {v[0], v[1], v[2]};
    next.spin_rad_s = {v[3], v[4], v[5]};
    return next;
}

TEST(RigidBody, HasTheMassMatrixOfABall) {
    const double a = 0.03, mass = 700.0 * 4.0 / 3.0 * kPi * a * a * a;
    const Matrix6 m = RigidBody(Sphere{a}, 700.0).mass_matrix(glm::dquat(1.0, 0.0, 0.0, 0.0));
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
            const double expected = i != j ? 0.0 : i < 3 ? mass : 0.4 * mass * a * a;
            EXPECT_NEAR(m[i][j], expected, 1e-14 * mass) << i << ", " << j;
        }
}

TEST(RigidBody, HasASymmetricMassMatrixInAnyPose) {
    const glm::dquat pose = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)));
    const Matrix6 m = RigidBody(kPaddle, 900.0).mass_matrix(pose);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(m[i][j], m[j][i], 1e-12 * m[0][0]);
    EXPECT_GT(std::abs(m[0][5]), 1e-3 * m[0][0]) << "its centre of mass is not its centre";
}

TEST(RigidBody, TurnsByTheAngleThatItsSpinSays) {
    const glm::dquat turned_by = turned(glm::angleAxis(0.5, glm::dvec3(0.0, 0.0, 1.0)), {0.0, 0.0, 2.0}, 0.1);
    EXPECT_LT(
        glm::distance(turned_by * glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(std::cos(0.7), std::sin(0.7), 0.0)),
        1e-15);
}

TEST(RigidBody, ThrownFreelyMovesItsCentreOfMassStraightOn) {
    const RigidBody body(kPaddle, 900.0);
    const glm::dvec3 arm = mass_properties(kPaddle).centre_m;
    BodyState state{.centre_m = glm::dvec3(0.1),
                    .orientation = glm::angleAxis(0.3, glm::normalize(glm::dvec3(1.0, 1.0, 0.0))),
                    .velocity_m_s = {0.1, 0.2, -0.1},
                    .spin_rad_s = {3.0, -2.0, 5.0}};
    const auto centre_of_mass = [&] { return state.centre_m + state.orientation * arm; };
    const glm::dvec3 start = centre_of_mass();
    const glm::dvec3 velocity = state.velocity_m_s + glm::cross(state.spin_rad_s, state.orientation * arm);
    for (int i = 0; i < 100; ++i) state = drift(body, state, 0.01);
    EXPECT_LT(glm::distance(centre_of_mass(), start + velocity), 1e-9);
}

TEST(RigidBody, ThrownFreelyKeepsItsAngularMomentumWhileItTumbles) {
    const RigidBody body(Cuboid{{0.01, 0.02, 0.04}}, 900.0);
    BodyState state{.spin_rad_s = {0.1, 6.0, 0.1}};  // about the middle axis, which does not last
    const Vector6 before = body.momentum(state, state.orientation);
    double least = 6.0;
    for (int i = 0; i < 4000; ++i) {
        state = drift(body, state, 0.001);
        least = std::min(least, (glm::conjugate(state.orientation) * state.spin_rad_s).y);
    }
    const Vector6 after = body.momentum(state, state.orientation);
    for (std::size_t i = 3; i < 6; ++i) EXPECT_NEAR(after[i], before[i], 1e-9 * before[4]);
    EXPECT_LT(least, -5.0) << "it has turned over";
}

}  // namespace
}  // namespace eddy::gles
