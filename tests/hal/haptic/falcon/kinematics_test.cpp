#include "hal/haptic/falcon/kinematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace eddy::falcon {
namespace {

// Known poses, from the closed form above libnifalcon's geometry, computed by an independent script.
struct Pose {
    glm::dvec3 p;  // [m, Base]
    Axes counts;
    std::array<Axes, 3> motors;       // for 1 N along x, y, z
    std::array<double, 3> max_force;  // [N] along x, y, z at the motors' limit
};
const Pose kPoses[] = {
    {{0, 0, .08},
     {-1284, -1284, -1284},
     {{{-99, 337, -238}, {332, -80, -252}, {-158, -158, -158}}},
     {12.1, 12.3, 25.9}},
    {{0, 0, .11},
     {-516, -516, -516},
     {{{-155, 527, -372}, {519, -126, -394}, {-242, -242, -242}}},
     {7.8, 7.9, 16.9}},
    {{0, 0, .13},
     {-96, -96, -96},
     {{{-186, 630, -444}, {620, -148, -471}, {-252, -252, -252}}},
     {6.5, 6.6, 16.3}},
    {{0, 0, .15},
     {336, 336, 336},
     {{{-213, 709, -496}, {695, -163, -532}, {-228, -228, -228}}},
     {5.8, 5.9, 18.0}},
    {{0, 0, .17},
     {872, 872, 872},
     {{{-224, 718, -495}, {700, -156, -544}, {-158, -158, -158}}},
     {5.7, 5.9, 25.9}},
    {{.03, .02, .12},
     {-319, -590, 389},
     {{{-167, 486, -503}, {536, -125, -555}, {-308, -380, 0}}},
     {8.1, 7.4, 10.8}},
    {{-.04, .04, .14},
     {-349, 1107, 611},
     {{{-209, 973, -584}, {458, -48, -443}, {-505, 174, -263}}},
     {4.2, 8.9, 8.1}},
};

struct Reading {
    Axes counts;
    glm::dvec3 p_mm;
};
const Reading kReadings[] = {
    {{0, 0, 0}, {0, 0, 134.602}},
    {{500, 0, 0}, {6.671, -22.190, 139.978}},
    {{0, 500, 0}, {-22.552, 5.318, 139.978}},
    {{0, 0, 500}, {15.882, 16.872, 139.978}},
    {{-700, 300, 200}, {-14.500, 33.238, 124.877}},
    {{1000, 1000, 1000}, {0, 0, 173.603}},
    {{1200, 1200, 1200}, {0, 0, 178.126}},
};

/// Calls what with every point of a 4 mm grid over the workspace that the legs reach.
template <typename What>
int over_workspace(What what) {
    int points = 0;
    for (double z = 0.066; z <= 0.1781; z += 0.004)
        for (double y = -0.06; y <= 0.0601; y += 0.004)
            for (double x = -0.06; x <= 0.0601; x += 0.004) {
                const glm::dvec3 p(x, y, z);
                const auto legs = inverse_kinematics(p);
                if (!legs) continue;
                what(p, *legs);
                ++points;
            }
    return points;
}

TEST(FalconKinematics, GivesTheKnownCountsOfKnownPoses) {
    for (const Pose& pose : kPoses) {
        const auto legs = inverse_kinematics(pose.p);
        ASSERT_TRUE(legs);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(std::lround(encoder_count(legs->theta1[i])), pose.counts[i]);
    }
}

TEST(FalconKinematics, GivesTheKnownMotorValuesOfUnitForces) {
    for (const Pose& pose : kPoses) {
        const auto legs = inverse_kinematics(pose.p);
        ASSERT_TRUE(legs);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 force(0.0);
            force[axis] = 1.0;
            EXPECT_EQ(motors_for(*legs, force, kMotorUnitsPerNm).motors,
                      pose.motors[static_cast<std::size_t>(axis)])
                << "z = " << pose.p.z << ", axis " << axis;
        }
    }
}

TEST(FalconKinematics, SaturatesAtTheKnownForces) {
    for (const Pose& pose : kPoses) {
        const auto legs = inverse_kinematics(pose.p);
        for (int axis = 0; axis < 3; ++axis) {
            const double limit = pose.max_force[static_cast<std::size_t>(axis)];
            glm::dvec3 force(0.0);
            force[axis] = limit - 0.1;  // the table has one decimal and came from rounded motor values
            EXPECT_FALSE(motors_for(*legs, force, kMotorUnitsPerNm).saturated)
                << pose.p.z << " axis " << axis;
            force[axis] = limit + 0.1;
            EXPECT_TRUE(motors_for(*legs, force, kMotorUnitsPerNm).saturated) << pose.p.z << " axis " << axis;
        }
    }
}

TEST(FalconKinematics, FindsTheKnownPositionsOfCounts) {
    for (const Reading& reading : kReadings) {
        const auto p = ForwardKinematics().solve(arm_angles(reading.counts));
        ASSERT_TRUE(p);
        EXPECT_LT(glm::length(*p * 1e3 - reading.p_mm), 1e-3) << "[mm], the table has three decimals";
    }
}

TEST(FalconKinematics, HasTheKnownAnglesAndJacobianAt150mm) {
    const auto legs = inverse_kinematics({0, 0, 0.15});
    ASSERT_TRUE(legs);
    constexpr double kDegrees = 57.295779513;
    EXPECT_NEAR(legs->theta1[0] * kDegrees, 47.24, 0.005);
    EXPECT_NEAR(legs->theta2[0] * kDegrees, 122.0, 0.05);
    EXPECT_NEAR(legs->theta3[0] * kDegrees, 91.1, 0.05);
    const double rows[3][3] = {{2.68, -8.77, 14.64}, {-8.93, 2.06, 14.64}, {6.25, 6.71, 14.64}};
    const glm::dmat3 j = jacobian(*legs);
    for (int leg = 0; leg < 3; ++leg)
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(j[axis][leg], rows[leg][axis], 0.005);
}

TEST(FalconKinematics, HasAJacobianThatIsTheSlopeOfTheArmAngles) {
    constexpr double kH = 1e-6;  // [m]: central differences are good to about 1e-8 of the slope here
    double worst = 0.0;
    over_workspace([&](const glm::dvec3& p, const Legs& legs) {
        const glm::dmat3 j = jacobian(legs);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = kH;
            const auto ahead = inverse_kinematics(p + step);
            const auto behind = inverse_kinematics(p - step);
            if (!ahead || !behind) continue;
            for (int leg = 0; leg < 3; ++leg) {
                const auto i = static_cast<std::size_t>(leg);
                const double slope = (ahead->theta1[i] - behind->theta1[i]) / (2 * kH);
                const double scale = std::max(10.0, std::abs(slope));
                // Near the end of reach the slope itself changes too fast for differences.
                if (std::abs(slope) < 100.0) worst = std::max(worst, std::abs(j[axis][leg] - slope) / scale);
            }
        }
    });
    EXPECT_LT(worst, 1e-5);  // measured 4e-6, at the edge of the reach; squaring sin(theta2) makes it 0.3
}

TEST(FalconKinematics, FindsEveryPoseOfTheWorkspaceAgainFromAfar) {
    double worst = 0.0;
    int lost = 0;
    ForwardKinematics across;  // goes on from point to point, with jumps at the ends of the rows
    const int points = over_workspace([&](const glm::dvec3& p, const Legs& legs) {
        const auto afresh = ForwardKinematics().solve(legs.theta1);
        const auto onwards = across.solve(legs.theta1);
        if (!afresh || !onwards) {
            ++lost;
            return;
        }
        worst = std::max({worst, glm::length(*afresh - p), glm::length(*onwards - p)});
    });
    EXPECT_GT(points, 20000);
    EXPECT_EQ(lost, 0);
    EXPECT_LT(worst, 1e-6) << "[m]";
}

TEST(FalconKinematics, SaysWhenThereIsNoPose) {
    EXPECT_FALSE(inverse_kinematics({0, 0, 0.19}));
    EXPECT_FALSE(inverse_kinematics({0, 0, 0.05}));
    EXPECT_FALSE(inverse_kinematics({0.2, 0, 0.12}));
    EXPECT_FALSE(inverse_kinematics({std::numeric_limits<double>::quiet_NaN(), 0, 0.12}));
    ForwardKinematics kinematics;
    EXPECT_FALSE(kinematics.solve(arm_angles({2500, -2500, 2500})));
    EXPECT_TRUE(kinematics.solve(arm_angles({336, 336, 336}))) << "and goes on afterwards";
}

TEST(FalconForce, ComesBackFromItsMotorValues) {
    std::mt19937_64 random(3);
    const auto uniform = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
    for (int i = 0; i < 1000; ++i) {
        const auto legs = inverse_kinematics({0.04 * uniform(), 0.04 * uniform(), 0.125 + 0.03 * uniform()});
        ASSERT_TRUE(legs);
        const glm::dvec3 force(2.0 * uniform(), 2.0 * uniform(), 2.0 * uniform());
        const MotorForce motors = motors_for(*legs, force, kMotorUnitsPerNm);
        ASSERT_FALSE(motors.saturated);
        // Each motor is rounded by at most half a unit of 1e-4 N m; arms of 40 mm and longer make 5 mN of
        // three.
        EXPECT_LT(glm::length(force_of(*legs, motors.motors, kMotorUnitsPerNm) - force), 0.005);
    }
}

TEST(FalconForce, KeepsItsDirectionWhenTheMotorsSaturate) {
    const auto legs = inverse_kinematics({0.03, 0.02, 0.12});
    const glm::dvec3 wanted(40.0, -25.0, 60.0);
    const MotorForce motors = motors_for(*legs, wanted, kMotorUnitsPerNm);
    EXPECT_TRUE(motors.saturated);
    const glm::dvec3 got = force_of(*legs, motors.motors, kMotorUnitsPerNm);
    EXPECT_LT(glm::length(glm::normalize(got) - glm::normalize(wanted)), 1e-3);
    int largest = 0;
    for (const int motor : motors.motors) largest = std::max(largest, std::abs(motor));
    EXPECT_EQ(largest, kMaxMotor);
}

TEST(FalconForce, IsZeroWhereItIsNotFinite) {
    const auto legs = inverse_kinematics({0, 0, 0.125});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(motors_for(*legs, {nan, 0, 0}, kMotorUnitsPerNm).motors, Axes{});
    EXPECT_EQ(motors_for(*legs, {0, inf, 0}, kMotorUnitsPerNm).motors, Axes{});
    EXPECT_EQ(motors_for(*legs, {0, 0, -1e308}, kMotorUnitsPerNm).motors, Axes{});
}

TEST(FalconFrames, StartTheDeviceFrameInTheMiddleOfTheWorkspace) {
    EXPECT_EQ(device_from_base({0.01, -0.02, 0.125}), glm::dvec3(0.01, -0.02, 0.0));
    EXPECT_EQ(base_from_device({0.01, -0.02, 0.0}), glm::dvec3(0.01, -0.02, 0.125));
}

}  // namespace
}  // namespace eddy::falcon
