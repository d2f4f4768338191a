#include "hal/haptic/falcon/usb_link.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/usb/usb_rig.h"

// Which device is opened, and what is said of those that cannot be. All through the real libusb.

namespace eddy {
namespace {

using ::testing::HasSubstr;
using namespace falcon;

TEST(UsbLink, FindsTheFalconAndReadsItsSerialString) {
    UsbRig rig{UsbRig::NoDevice{}};
    rig.port = rig.add({}, {.serial = "FTPNM0FB"});
    rig.start();
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("FTPNM0FB"));
    EXPECT_EQ(rig.port->opened, 1);
    EXPECT_EQ(rig.port->claimed, 1);
}

TEST(UsbLink, NeverOpensAnotherDeviceWithAnFtdiChip) {
    UsbRig rig{UsbRig::NoDevice{}};
    const usb::Port* other =
        rig.add({}, {.product = 0x6001, .product_name = "FT232R USB UART", .serial = "A1"});
    rig.start();
    EXPECT_FALSE(falcon_is_plugged_in());
    rig.run(1000);
    EXPECT_EQ(rig.driver->state(), HapticState::Absent);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("plug it in"));
    rig.port = rig.add();
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    EXPECT_TRUE(falcon_is_plugged_in());
    EXPECT_EQ(other->opened, 0);
}

TEST(UsbLink, TakesTheFalconWithTheSerialAskedFor) {
    UsbRig rig{UsbRig::NoDevice{}};
    const usb::Port* first = rig.add({}, {.serial = "12PZ657E"});
    rig.port = rig.add({}, {.serial = "FTPNM0FB"});
    const usb::Port* third = rig.add({}, {.serial = "FTPNM0FC"});
    rig.start("FTPNM0FB");
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("FTPNM0FB"));
    EXPECT_EQ(rig.port->claimed, 1);
    EXPECT_EQ(first->claimed + third->claimed, 0) << "those were asked for their names and left alone";
}

TEST(UsbLink, SaysThatOnlyAnotherSerialIsThere) {
    UsbRig rig{UsbRig::NoDevice{}};
    rig.port = rig.add({}, {.serial = "12PZ657E"});
    rig.start("FTPNM0FB");
    rig.run(1000);
    EXPECT_EQ(rig.driver->state(), HapticState::Absent);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("not the one with the serial"));
    EXPECT_EQ(rig.port->claimed, 0);
}

TEST(UsbLink, SaysThatItMayNotBeOpenedAndTakesItOnceItMay) {
    UsbRig rig;
    rig.port->denied = true;
    rig.run(500);
    EXPECT_EQ(rig.driver->state(), HapticState::Absent);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("udev rule"));
    rig.port->denied = false;
    EXPECT_GE(rig.until(HapticState::Ready, 500), 0);
}

TEST(UsbLink, SaysThatAnotherProgramHasItAndTakesItWhenThatEnds) {
    UsbRig rig;
    rig.port->claimed_by_another = true;
    rig.run(500);
    EXPECT_EQ(rig.driver->state(), HapticState::Absent);
    EXPECT_THAT(rig.driver->describe(), HasSubstr("another program"));
    EXPECT_EQ(rig.port->device.falcon().requests().size(), 0U) << "it is not disturbed";
    rig.port->claimed_by_another = false;
    EXPECT_GE(rig.until(HapticState::Ready, 500), 0);
}

TEST(UsbLink, TakesItFromADriverOfTheKernel) {
    UsbRig rig;
    rig.port->bound_to_driver = true;
    EXPECT_GE(rig.until(HapticState::Ready, 500), 0);
    EXPECT_FALSE(rig.port->bound_to_driver);
}

TEST(UsbLink, TakesTheOtherFalconWhileOneIsInUse) {
    UsbRig rig{UsbRig::NoDevice{}};
    usb::Port* first = rig.add({}, {.serial = "12PZ657E"});
    first->claimed_by_another = true;
    rig.port = rig.add({}, {.serial = "FTPNM0FB"});
    rig.start();
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    EXPECT_EQ(rig.port->claimed, 1);
}

// With many milliseconds between polls, packets wait in the reads that are queued and none is lost.
TEST(UsbLink, LosesNothingWhileTheLoopIsLate) {
    UsbRig rig({}, with_firmware());
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    const auto before = rig.driver->counters();
    for (int i = 0; i < 100; ++i) {
        rig.run(5);
        rig.now += std::chrono::milliseconds(8);
    }
    const auto after = rig.driver->counters();
    EXPECT_EQ(after.timeouts, before.timeouts);
    EXPECT_EQ(after.bad_bytes, before.bad_bytes);
}

TEST(UsbLink, SendsZeroTorqueLast) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(10, {2.0, 0.0, 0.0});
    ASSERT_NE(rig.board().last_command().motors, Axes{});
    const auto frames = rig.board().frames();
    rig.driver.reset();
    rig.bus().advance(rig.bus().now() + std::chrono::milliseconds(2));
    EXPECT_GT(rig.board().frames(), frames);
    EXPECT_EQ(rig.board().last_command(), Command{});
    EXPECT_EQ(rig.board().dropped_bytes(), 0U);
}

TEST(UsbLink, LetsADeviceGoThatDoesNotAnswer) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.device().stalled = true;
    rig.driver.reset();  // must return
    rig.device().stalled = false;
    rig.start();
    EXPECT_GE(rig.until(HapticState::Ready, 1000), 0) << "and the next program can have it";
}

TEST(UsbLink, ClosesWhileSomethingIsUnderWay) {
    for (int ms = 0; ms < 40; ++ms) {
        UsbRig rig(cold(), with_firmware());
        rig.run(ms * 30);
        rig.driver.reset();
        rig.start();
        ASSERT_GE(rig.until(HapticState::Homing, 5000), 0) << ms;
    }
}

}  // namespace
}  // namespace eddy
