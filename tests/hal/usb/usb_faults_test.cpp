#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "tests/hal/usb/usb_rig.h"

// What the driver makes of a device that misbehaves, through the real libusb: its asynchronous transfers, short
// packets, stalls, cancellation, and devices that vanish; DeviceFaults without USB between as well. falcon_faults_test.cpp asks
// more of the driver itself.

namespace eddy {
namespace {

using namespace falcon;
using namespace std::chrono_literals;
using emulated::BoardState;

const glm::dvec3 kPush(2.0, 0.0, 0.0);

/// Where the hand is, to the resolution of the encoders.
void expect_true_positions(const DriverRig& rig) {
    EXPECT_LT(glm::length(rig.last.position_m), 60e-6) << "a position was made up";
}

template <class AnyRig>
struct DeviceFaults : testing::Test {};
using Rigs = testing::Types<Rig, UsbRig>;
TYPED_TEST_SUITE(DeviceFaults, Rigs);

TYPED_TEST(DeviceFaults, LostRepliesCostNothingButTime) {
    TypeParam rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.board().faults.lost_replies = 3;
    rig.run(200, kPush);
    EXPECT_EQ(rig.driver->counters().timeouts, 3U);
    EXPECT_EQ(rig.driver->state(), HapticState::Ready);
    EXPECT_NE(rig.board().last_command().motors, Axes{});
    expect_true_positions(rig);
}

TYPED_TEST(DeviceFaults, RepliesOfFourteenBytesAreNotReplies) {
    TypeParam rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.board().faults.short_replies = 3;
    rig.run(200, kPush);
    EXPECT_EQ(rig.driver->counters().timeouts, 3U);
    EXPECT_EQ(rig.driver->counters().bad_bytes, 3U * 14U);
    expect_true_positions(rig);
}

TYPED_TEST(DeviceFaults, NonsenseBetweenRepliesIsSkipped) {
    TypeParam rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.board().faults.garbage = 50;
    rig.run(200, kPush);
    EXPECT_EQ(rig.driver->counters().bad_bytes, 50U * 5U);
    EXPECT_EQ(rig.driver->counters().timeouts, 0U);
    expect_true_positions(rig);
}

TYPED_TEST(DeviceFaults, RepliesSentTwiceDoNoHarm) {
    TypeParam rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.board().faults.double_replies = 20;
    rig.run(800, kPush);
    EXPECT_EQ(rig.board().faults.double_replies, 0);
    EXPECT_EQ(rig.driver->state(), HapticState::Ready);
    expect_true_positions(rig);
}

TYPED_TEST(DeviceFaults, PacketsWithoutAnythingInThemAreSilence) {
    TypeParam rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.device().line_dead = true;
    rig.run(2000);
    EXPECT_EQ(rig.driver->counters().lost, 1U);
    EXPECT_NE(rig.driver->state(), HapticState::Ready);
    rig.device().line_dead = false;
    EXPECT_GE(rig.until(HapticState::Ready, 1000), 0);
}

TYPED_TEST(DeviceFaults, AJumpOfTheEncodersIsNotFollowed) {
    TypeParam rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10);
    rig.board().faults.encoder_error = {900, 0, 0};
    rig.run(1);
    rig.board().faults.encoder_error = {};
    for (int i = 0; i < 20; ++i) {
        rig.tick();
        expect_true_positions(rig);
    }
    EXPECT_EQ(rig.driver->counters().implausible, 1U);
}

TYPED_TEST(DeviceFaults, LostHomingEndsTheForce) {
    TypeParam rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10, kPush);
    rig.board().faults.homing_lost = true;
    rig.run(3, kPush);
    EXPECT_EQ(rig.driver->state(), HapticState::Homing);
    EXPECT_EQ(rig.board().last_command().motors, Axes{});
    EXPECT_EQ(rig.driver->counters().rehomed, 1U);
}

TYPED_TEST(DeviceFaults, ALossOfPowerWhileRunningIsLoadedAgain) {
    TypeParam rig({}, with_firmware(200), std::make_unique<Path>([](double t) {
                      return glm::dvec3(0.0, 0.0, 0.045 * std::sin(M_PI * t));
                  }));
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.board().lose_power();
    ASSERT_GE(rig.until(HapticState::Loading, 4000), 0);
    EXPECT_GE(rig.until(HapticState::Ready, 8000), 0);
}

// Without the event character both wait for the latency timer and travel together.
TEST(UsbFaults, TwoRepliesInOnePacketAreBothRead) {
    UsbRig rig({}, {.flush_on_frame_end = false});
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.board().faults.double_replies = 50;
    rig.run(500, kPush);
    EXPECT_EQ(rig.driver->counters().bad_bytes, 0U);
    EXPECT_EQ(rig.driver->counters().timeouts, 0U);
    expect_true_positions(rig);
}

TEST(UsbFaults, RepliesMayComeByteByByte) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.device().splits = true;
    const auto before = rig.driver->counters().exchanges;
    rig.run(1000, kPush);
    EXPECT_GT(rig.driver->counters().exchanges - before, 300U);
    EXPECT_EQ(rig.driver->counters().timeouts, 0U);
    EXPECT_EQ(rig.driver->counters().bad_bytes, 0U);
    expect_true_positions(rig);
}

TEST(UsbFaults, AWrongEchoAnywhereMeansAnotherUpload) {
    for (const int at : {0, 61, 62, 1000, 8489}) {
        UsbRig rig(cold(), with_firmware());
        rig.board().faults.wrong_echo_at = at;
        ASSERT_GE(rig.until(HapticState::Homing, 8000), 0) << at;
        EXPECT_EQ(rig.driver->counters().wrong_echoes, 1U) << at;
        EXPECT_EQ(rig.driver->counters().failed_boots, 1U) << at;
    }
}

TEST(UsbFaults, ADeafPicIsCalledAgain) {
    UsbRig rig(cold(), with_firmware(100));
    rig.board().faults.deaf_calls = 15;
    EXPECT_GE(rig.until(HapticState::Homing, 5000), 0);
    EXPECT_EQ(rig.driver->counters().failed_boots, 0U);
}

TEST(UsbFaults, AnswersOfThePicThatComeLateAreNotTakenForAnEcho) {
    for (const auto delay : {90ms, 150ms}) {
        UsbRig rig(cold(), with_firmware(100));
        rig.board().faults.slow_answer = delay;
        EXPECT_GE(rig.until(HapticState::Homing, 20000), 0) << delay.count();
        EXPECT_EQ(rig.driver->counters().wrong_echoes, 0U) << delay.count();
    }
}

TEST(UsbFaults, RepliesMayTakeFiveMilliseconds) {
    for (const auto delay : {2ms, 5ms}) {
        UsbRig rig;
        ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
        rig.board().faults.slow_reply = delay;
        rig.run(1000, kPush);
        EXPECT_EQ(rig.driver->counters().timeouts, 0U) << delay.count();
        EXPECT_NE(rig.board().last_command().motors, Axes{}) << delay.count();
        expect_true_positions(rig);
    }
}

// Replies have no number: if old ones were taken for new, the hand would be pushed by where it was 50 ms ago.
TEST(UsbFaults, NobodyIsPushedWhileRepliesTakeFiftyMilliseconds) {
    UsbRig rig(left_to_the_driver());
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10, kPush);
    rig.board().faults.slow_reply = 50ms;
    rig.run(20, kPush);
    for (int ms = 0; ms < 3000; ++ms) {
        rig.tick(kPush);
        ASSERT_EQ(rig.board().last_command().motors, Axes{}) << ms;
    }
    EXPECT_GT(rig.driver->counters().timeouts, 10U);
    rig.board().faults.slow_reply = 0ms;
    rig.run(500, kPush);
    EXPECT_NE(rig.board().last_command().motors, Axes{}) << "and it recovers";
}

TEST(UsbFaults, TwoHomedAxesAreNotEnough) {
    UsbRig rig(unhomed(), {}, still({0.0, 0.0, -0.045}));
    rig.board().faults.no_index = true;
    rig.run(3000, kPush);
    EXPECT_EQ(rig.driver->state(), HapticState::Homing);
    EXPECT_EQ(rig.board().largest_motor(), 0);
}

TEST(UsbFaults, BouncingButtonsAreNotPressed) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    for (int i = 0; i < 200; ++i) {
        rig.board().buttons = i % 3 == 0 ? 0x4 : 0x0;
        rig.tick();
        ASSERT_EQ(rig.last.buttons, 0);
    }
}

// The electronics live on USB, the motors and the index marks do not.
TEST(UsbFaults, WithoutItsSupplyItCannotBeHomedAndSaysWhatToDo) {
    UsbRig rig(unhomed(), {}, still({0.0, 0.0, -0.045}));
    rig.board().faults.no_supply = true;
    rig.run(3000, kPush);
    EXPECT_EQ(rig.driver->state(), HapticState::Homing);
    EXPECT_EQ(rig.board().largest_motor(), 0);
    EXPECT_THAT(rig.driver->describe(), ::testing::HasSubstr("30 V"));
    rig.board().faults.no_supply = false;
    EXPECT_GE(rig.until(HapticState::Ready, 1000), 0);
}

TEST(UsbFaults, StalledPipesAreCountedAndOpenedAfresh) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10, kPush);
    rig.device().stalled = true;
    rig.run(2000, kPush);
    EXPECT_NE(rig.driver->state(), HapticState::Ready);
    EXPECT_GT(rig.driver->counters().usb_errors, 0U);
    const int opened = rig.port->opened;
    EXPECT_GT(opened, 1);
    rig.device().stalled = false;
    EXPECT_GE(rig.until(HapticState::Ready, 6000), 0);
}

// The host clears a halt, or it stays; the other endpoint goes on as if nothing were wrong.
TEST(UsbFaults, AnEndpointThatHaltsIsClearedAndObeyedAgain) {
    for (const auto endpoint : {emulated::Urb::Pipe::Out, emulated::Urb::Pipe::In}) {
        UsbRig rig;
        ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
        rig.run(10, kPush);
        rig.port->device.halt(endpoint);
        rig.run(20, kPush);
        const auto frames = rig.board().frames();
        rig.run(3000, kPush);
        EXPECT_EQ(rig.driver->state(), HapticState::Ready);
        EXPECT_GT(rig.board().frames() - frames, 2000U);
        EXPECT_NE(rig.board().last_command().motors, Axes{});
        EXPECT_EQ(rig.port->opened, 2);
        expect_true_positions(rig);
    }
}

// A cable moved in its socket: transfers fail, and work again.
TEST(UsbFaults, AMomentOfGarbledTransfersIsOutlived) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.port->device.garbled = true;
    rig.run(2, kPush);
    rig.port->device.garbled = false;
    rig.run(100, kPush);
    EXPECT_EQ(rig.driver->state(), HapticState::Ready);
    EXPECT_EQ(rig.port->opened, 1);
    EXPECT_GT(rig.driver->counters().usb_errors, 8U);
    EXPECT_NE(rig.board().last_command().motors, Axes{});
    expect_true_positions(rig);
}

TEST(UsbFaults, ACableThatStaysBadIsOpenedAfreshUntilItIsGood) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.port->device.garbled = true;
    rig.run(1000, kPush);
    EXPECT_NE(rig.driver->state(), HapticState::Ready);
    EXPECT_GT(rig.port->opened, 2);
    rig.port->device.garbled = false;
    EXPECT_GE(rig.until(HapticState::Ready, 1000), 0);
}

// Requests that never end are called off at their deadline, so that the next try can begin.
TEST(UsbFaults, ADeviceThatHangsIsGivenUpAndTakenBackWhenItWakes) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10, kPush);
    rig.port->device.hung = true;
    ASSERT_GE(rig.until(HapticState::Booting, 5000, kPush), 0);
    const auto errors = rig.driver->counters().usb_errors;
    rig.run(5000, kPush);
    EXPECT_GT(rig.driver->counters().usb_errors, errors) << "control requests past their second";
    rig.port->device.hung = false;
    EXPECT_GE(rig.until(HapticState::Ready, 10000), 0);
}

TEST(UsbFaults, AProgramCanEndWhileTheDeviceHangs) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.port->device.hung = true;
    rig.run(3);
    const auto began = std::chrono::steady_clock::now();
    rig.driver.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - began, 2s);
    rig.port->device.hung = false;
    rig.start();
    EXPECT_GE(rig.until(HapticState::Ready, 1000), 0);
}

TEST(UsbFaults, AnUploadMayBeUnpluggedAtAnyTime) {
    for (int ms = 40; ms < 1400; ms += 60) {
        UsbRig rig(cold(), with_firmware());
        rig.run(ms);
        rig.bus().unplug(*rig.port);
        ASSERT_GE(rig.until(HapticState::Absent, 100), 0) << ms;
        rig.run(20);
        rig.bus().replug(*rig.port, false);
        ASSERT_GE(rig.until(HapticState::Homing, 5000), 0) << ms;
    }
}

TEST(UsbFaults, ALineAtAWrongRateIsReportedAndTriedAgain) {
    UsbRig rig(cold(), with_firmware(100));
    rig.device().rate_error = 0.1;
    ASSERT_GE(rig.until(HapticState::Fault, 60000), 0);
    EXPECT_EQ(rig.driver->counters().failed_boots, 10U);
    EXPECT_EQ(rig.driver->counters().given_up, 1U);
    rig.device().rate_error = 0.0;
    EXPECT_GE(rig.until(HapticState::Homing, 10000), 0);
}

}  // namespace
}  // namespace eddy
