#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/haptic/loop.h"
#include "hal/haptic/falcon/falcon.h"
#include "tests/hal/haptic/falcon/rig.h"

// What the driver makes of a device that misbehaves; what is asked with USB between as well is in usb/usb_faults_test.cpp.

namespace eddy {
namespace {

using ::testing::HasSubstr;
using namespace falcon;

TEST(FalconFaults, SendsZeroWithin20msOfALostReply) {
    Rig rig(left_to_the_driver());
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    const glm::dvec3 force(2.0, 0.0, 0.0);
    rig.run(10, force);
    rig.board().faults.lost_replies = 1;
    int ms = 0;
    while (rig.driver->counters().timeouts == 0 && ++ms < 50) rig.tick(force);
    int zero_after = ms;
    while (rig.board().last_command().motors != Axes{} && ++zero_after < 50) rig.tick(force);
    EXPECT_LT(zero_after, 20);
    rig.run(30, force);
    EXPECT_NE(rig.board().last_command().motors, Axes{}) << "replies are on time: forces are obeyed again";
    EXPECT_EQ(rig.driver->state(), HapticState::Ready);
    EXPECT_EQ(rig.driver->counters().timeouts, 1U);
}

TEST(FalconFaults, SendsZeroWhenNobodyCommandsIt) {
    Rig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(5, {2.0, 0.0, 0.0});
    for (int i = 0; i < 8; ++i) rig.driver->poll(rig.now += std::chrono::milliseconds(1));
    EXPECT_EQ(rig.board().last_command().motors, Axes{});
}

/// The loop on a Falcon whose board keeps its torque for a second, with a fluid that pushes with 4 N.
struct FalconLoop {
    emulated::EmulatedFalcon* device = nullptr;
    std::unique_ptr<Falcon> driver;
    HapticExchange exchange;
    TickTrace trace{1};
    std::optional<HapticLoop> loop;
    FluidSnapshot fluid{.force_n = {4.0, 0.0, 0.0}, .fluid_period = Seconds(0.020)};
    Instant now{0};
    double steepest_n = 0.0;  ///< the most that the force of the motors has risen in a tick

    FalconLoop() {
        auto emulated = std::make_unique<emulated::EmulatedFalcon>(
            still(), emulated::PlantSettings{.hand = emulated::Hand::OnPath}, left_to_the_driver());
        device = emulated.get();
        driver = std::make_unique<Falcon>(std::move(emulated), FalconSettings{});
        loop.emplace(*driver, exchange, trace);
        exchange.orders.publish(
            {.enabled = true, .lowest_m = glm::dvec3(-0.05), .highest_m = glm::dvec3(0.05)});
    }
    /// What the motors were last asked for [N].
    double motors_n() const {
        return glm::length(force_of(device->board().plant().legs(), device->board().last_command().motors,
                                    kMotorUnitsPerNm));
    }
    void run(int ms) {
        for (int i = 0; i < ms; ++i) {
            now += kTick;
            if (now / kTick % 20 == 1) {
                ++fluid.sequence;
                fluid.computed_for = exchange.pose.newest().time;
                exchange.fluid.publish(fluid);
            }
            const double before_n = motors_n();
            loop->tick(now);
            device->poll(now + std::chrono::microseconds(900));
            steepest_n = std::max(steepest_n, motors_n() - before_n);
        }
    }
};

TEST(FalconFaults, TheForceComesBackGentlyAfterALostReply) {
    FalconLoop rig;
    rig.run(2000);
    ASSERT_NEAR(rig.motors_n(), 4.0, 0.02);
    rig.steepest_n = 0.0;
    rig.device->board().faults.lost_replies = 1;
    rig.run(15);
    EXPECT_EQ(rig.device->board().last_command().motors, Axes{}) << "it was zero for a moment";
    rig.run(300);
    EXPECT_LT(rig.steepest_n, 0.05);
    EXPECT_NEAR(rig.motors_n(), 4.0, 0.02) << "and soon it is back";
}

TEST(FalconFaults, TheForceComesBackGentlyWhenThePoseIsKnownAgain) {
    FalconLoop rig;
    rig.run(2000);
    rig.steepest_n = 0.0;
    rig.device->board().faults.encoder_error = {2500, -2500, 2500};  // no pose has these
    rig.run(40);
    EXPECT_EQ(rig.device->board().last_command().motors, Axes{});
    rig.device->board().faults.encoder_error = {};
    rig.run(300);
    EXPECT_LT(rig.steepest_n, 0.05);
    EXPECT_NEAR(rig.motors_n(), 4.0, 0.02);
}

TEST(FalconFaults, ReportsANoisyLine) {
    Rig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("(0 line faults)"));
    rig.device().line_noisy = true;
    rig.run(3);
    rig.device().line_noisy = false;
    rig.run(3);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("(3 line faults)"));
}

TEST(FalconFaults, BelievesAJumpThatStays) {
    Rig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10);
    rig.board().faults.encoder_error = {900, 0, 0};
    rig.run(10);
    EXPECT_GT(glm::length(rig.last.position_m), 0.01);
    EXPECT_LE(rig.driver->counters().implausible, 4U);
}

TEST(FalconFaults, PushesNoHandWhosePositionItCannotTell) {
    Rig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10, {2.0, 0.0, 0.0});
    rig.board().faults.encoder_error = {2500, -2500, 2500};  // no pose has these
    const int readings = rig.readings;
    rig.run(40, {2.0, 0.0, 0.0});
    EXPECT_EQ(rig.board().last_command().motors, Axes{});
    EXPECT_LE(rig.readings, readings + 1);
    EXPECT_GT(rig.driver->counters().unsolved, 20U);
}

TEST(FalconFaults, IsAbsentWhileUnpluggedAndComesBack) {
    Rig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10, {1.0, 0.0, 0.0});
    rig.device().unplug();
    EXPECT_GE(rig.until(HapticState::Absent, 100), 0);
    EXPECT_EQ(rig.driver->counters().lost, 1U);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("0403:cb48"));
    rig.run(500, {1.0, 0.0, 0.0});
    EXPECT_EQ(rig.driver->state(), HapticState::Absent);
    EXPECT_GT(rig.driver->silence(rig.now).count(), 0.4);
    rig.device().plug_in(true);
    EXPECT_GE(rig.until(HapticState::Ready, 300), 0);
    rig.run(5, {1.0, 0.0, 0.0});
    EXPECT_LT(rig.driver->silence(rig.now).count(), 0.005);
}

TEST(FalconFaults, GoesToFaultWhenThePipesRefuseAndRecovers) {
    Rig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.device().stalled = true;
    ASSERT_GE(rig.until(HapticState::Fault, 10000), 0);
    rig.device().stalled = false;
    EXPECT_GE(rig.until(HapticState::Ready, 6000), 0);
}

}  // namespace
}  // namespace eddy
