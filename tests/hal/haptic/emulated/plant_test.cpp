#include "hal/haptic/emulated/plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/hal/haptic/falcon/rig.h"

namespace eddy::emulated {
namespace {

using namespace std::chrono_literals;

TEST(Plant, PutsTheHandleExactlyWhereAStrongHandIs) {
    const auto path = [](double t) {
        return glm::dvec3(0.04 * std::sin(5 * t), 0.03 * std::cos(3 * t), 0.01 * std::sin(t));
    };
    Plant plant(std::make_unique<Path>(path), {.hand = Hand::OnPath});
    for (int ms = 1; ms < 3000; ++ms) {
        plant.advance(std::chrono::milliseconds(ms), glm::dvec3(5.0));
        ASSERT_EQ(plant.position_m(), path(ms / 1000.0));
    }
}

// m x'' + b x' + k x = F from rest at 0, with the sums of arm and handle: the answer of every textbook.
TEST(Plant, AnswersAStepOfForceAsAMassSpringDamper) {
    const PlantSettings s{.hand = Hand::Arm};
    Plant plant(still(), s);
    const double m = s.handle_mass_kg + s.arm_mass_kg;
    const double b = s.handle_damping_ns_m + s.arm_damping_ns_m;
    const double k = s.arm_stiffness_n_m;
    const double rate = b / (2 * m);
    const double omega = std::sqrt(k / m - rate * rate);
    const double force = 2.0;
    double worst = 0.0;
    for (int ms = 1; ms <= 2000; ++ms) {
        plant.advance(std::chrono::milliseconds(ms), {force, 0.0, 0.0});
        const double t = ms / 1000.0;
        const double exact =
            force / k *
            (1.0 - std::exp(-rate * t) * (std::cos(omega * t) + rate / omega * std::sin(omega * t)));
        worst = std::max(worst, std::abs(plant.position_m().x - exact));
    }
    // First order in the step of 0.25 ms: about omega * dt / 2 of the 15 mm it moves.
    EXPECT_LT(worst, 30e-6);
    EXPECT_NEAR(plant.position_m().x, force / k, 1e-5);
}

TEST(Plant, PullsTheHandleAfterTheHand) {
    Plant plant(std::make_unique<Path>([](double t) { return glm::dvec3(t < 0.1 ? 0.0 : 0.03, 0.0, 0.0); }),
                {.hand = Hand::Arm});
    plant.advance(100ms, glm::dvec3(0.0));
    EXPECT_LT(plant.position_m().x, 0.001);
    for (int ms = 100; ms <= 3000; ++ms) plant.advance(std::chrono::milliseconds(ms), glm::dvec3(0.0));
    EXPECT_NEAR(plant.position_m().x, 0.03, 1e-5);
}

TEST(Plant, FollowsAHandOnlyWhileItIsHeld) {
    Plant plant(std::make_unique<Path>([](double t) { return glm::dvec3(t < 0.1 ? 0.0 : 0.03, 0.0, 0.0); }),
                {.hand = Hand::Arm});
    plant.let_go();
    plant.advance(900ms, glm::dvec3(0.0));
    EXPECT_EQ(plant.position_m().x, 0.0);
    plant.hold(Hand::Arm);
    for (int ms = 900; ms <= 4000; ++ms) plant.advance(std::chrono::milliseconds(ms), glm::dvec3(0.0));
    EXPECT_NEAR(plant.position_m().x, 0.03, 1e-5);
}

TEST(Plant, LosesEnergyWhenLeftAlone) {
    Plant plant(still(), {.hand = Hand::Arm});
    const PlantSettings s;
    plant.advance(300ms, {3.0, 1.0, -2.0});
    const auto energy = [&] {
        const double speed = glm::length(plant.velocity_m_s());
        const double stretch = glm::length(plant.position_m());
        return 0.5 * (s.handle_mass_kg + s.arm_mass_kg) * speed * speed +
               0.5 * s.arm_stiffness_n_m * stretch * stretch;
    };
    double last = energy();
    EXPECT_GT(last, 0.01);
    for (int i = 0; i < 200; ++i) {
        plant.advance(300ms + (i + 1) * 10ms, glm::dvec3(0.0));
        EXPECT_LE(energy(), last * (1.0 + 1e-3));
        last = energy();
    }
    EXPECT_LT(last, 1e-6);
}

TEST(Plant, NeverLeavesWhatTheLegsCanReach) {
    for (const Hand hand : {Hand::OnPath, Hand::Arm}) {
        Plant plant(std::make_unique<Path>([](double t) {
                        return glm::dvec3(0.2 * std::sin(9 * t), 0.2 * std::sin(7 * t),
                                          0.15 * std::sin(11 * t));
                    }),
                    {.hand = hand});
        double farthest = 0.0;
        for (int ms = 1; ms < 5000; ++ms) {
            plant.advance(std::chrono::milliseconds(ms), {20.0 * std::sin(0.1 * ms), 0.0, 20.0});
            const glm::dvec3 p = plant.position_m();
            ASSERT_TRUE(falcon::inverse_kinematics(falcon::base_from_device(p)));
            ASSERT_LE(std::max(std::abs(p.x), std::abs(p.y)), 0.060);
            ASSERT_GE(p.z, -0.060);
            ASSERT_LE(p.z, 0.053 + 1e-12);
            farthest = std::max(farthest, glm::length(p));
        }
        EXPECT_GT(farthest, 0.06) << "it was pushed to its stops";
    }
}

TEST(Plant, ComesToRestAtAStop) {
    Plant plant(still(), {.hand = Hand::Arm});
    for (int ms = 1; ms <= 2000; ++ms) plant.advance(std::chrono::milliseconds(ms), {0.0, 0.0, -30.0});
    EXPECT_NEAR(plant.position_m().z, -0.060, 1e-12);
    EXPECT_NEAR(plant.velocity_m_s().z, 0.0, 1e-12);
}

TEST(Plant, StartsAfreshAfterAPauseInsteadOfCatchingUp) {
    Plant plant(std::make_unique<Path>([](double t) { return glm::dvec3(t > 100 ? 0.02 : 0.0, 0.0, 0.0); }),
                {.hand = Hand::Arm});
    plant.advance(1h, glm::dvec3(0.0));
    EXPECT_DOUBLE_EQ(plant.position_m().x, 0.02);
    EXPECT_EQ(plant.velocity_m_s(), glm::dvec3(0.0));
}

}  // namespace
}  // namespace eddy::emulated
