#include "tests/redir/falcon_peer.h"

#include <gtest/gtest.h>

#include "tests/hal/haptic/falcon/rig.h"
#include "tests/redir/redir_link.h"

// The real driver, the socket's protocol between, and the emulated Falcon with its hand.

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;

struct RedirRig : DriverRig {
    explicit RedirRig(FalconPeerSettings peer_settings = {}, FalconSettings driver_settings = {},
                      const glm::dvec3& place = glm::dvec3(0.0))
        : peer(still(place), peer_settings), wire(peer) {
        driver = std::make_unique<Falcon>(std::make_unique<RedirLink>(wire), std::move(driver_settings));
    }
    ~RedirRig() override {
        driver.reset();
        EXPECT_TRUE(wire.guest.complaints.empty()) << wire.guest.complaints.front();
    }
    RedirRig(const RedirRig&) = delete;
    RedirRig& operator=(const RedirRig&) = delete;

    void advance() override { now += 1ms; }
    emulated::EmulatedFalcon& device() override { return peer.device().falcon(); }
    void say(const std::string& line) { EXPECT_EQ(peer.command(now, line), ""); }

    FalconPeer peer;
    Wire wire;
};

TEST(RedirFalcon, StartsFromColdIsHomedByTheHandAndGetsReady) {
    RedirRig rig({.start = emulated::BoardState::Cold}, with_firmware());
    ASSERT_GE(rig.until(HapticState::Loading, 1000), 0);
    ASSERT_GE(rig.until(HapticState::Homing, 4000), 0);
    EXPECT_EQ(rig.board().state(), emulated::BoardState::RunUnhomed);
    ASSERT_GE(rig.until(HapticState::Ready, 5000), 0);
    EXPECT_EQ(rig.board().largest_motor_unhomed(), 0);
    EXPECT_EQ(rig.driver->counters().wrong_echoes, 0U);
}

TEST(RedirFalcon, NobodyHomesItIfNobodyIsThere) {
    RedirRig rig({.start = emulated::BoardState::RunUnhomed, .homes = false});
    ASSERT_GE(rig.until(HapticState::Homing, 1000), 0);
    EXPECT_EQ(rig.until(HapticState::Ready, 8000), -1);
    rig.say("home");
    EXPECT_GE(rig.until(HapticState::Ready, 5000), 0);
}

TEST(RedirFalcon, ExchangesNineHundredTimesASecond) {
    RedirRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    const auto before = rig.driver->counters().exchanges;
    rig.run(2000, {0.5, 0.0, 0.0});
    EXPECT_GE(rig.driver->counters().exchanges - before, 1800U);
    EXPECT_EQ(rig.driver->counters().timeouts, 0U);
    EXPECT_EQ(rig.driver->counters().bad_bytes, 0U);
}

TEST(RedirFalcon, TheForceArrivesAtTheHandAndTheHandAtTheDriver) {
    RedirRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(200, {0.0, 1.0, -0.5});
    EXPECT_NEAR(rig.peer.force_n().x, 0.0, 0.01);
    EXPECT_NEAR(rig.peer.force_n().y, 1.0, 0.01);
    EXPECT_NEAR(rig.peer.force_n().z, -0.5, 0.01);
    rig.say("hold 0.02 -0.01 0.015");
    rig.run(1500);
    EXPECT_LT(glm::distance(rig.last.position_m, glm::dvec3(0.02, -0.01, 0.015)), 1e-3);
    rig.say("follow");
    rig.run(1500);
    EXPECT_LT(glm::length(rig.last.position_m), 1e-3);
}

TEST(RedirFalcon, AHandleLetGoYieldsToAForceThatAHandWithstands) {
    RedirRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(1000, {0.5, 0.0, 0.0});
    const double held_m = rig.last.position_m.x;
    EXPECT_LT(held_m, 0.006);
    rig.say("let-go");
    rig.run(1000, {0.5, 0.0, 0.0});
    EXPECT_GT(rig.last.position_m.x, 0.04);
    rig.say("hold 0 0 0");
    rig.run(2000);
    EXPECT_LT(glm::length(rig.last.position_m), 1e-3);
}

TEST(RedirFalcon, ButtonsArePressedForSoLong) {
    RedirRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.say("press 2 100ms");
    rig.run(50);
    EXPECT_EQ(rig.last.buttons, 4U);
    rig.run(100);
    EXPECT_EQ(rig.last.buttons, 0U);
    rig.say("press 0");
    rig.run(200);
    EXPECT_EQ(rig.last.buttons, 1U);
    rig.say("release 0");
    rig.run(50);
    EXPECT_EQ(rig.last.buttons, 0U);
}

TEST(RedirFalcon, ASilentOneIsLostAndFoundAgain) {
    RedirRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.say("silent 4s");
    rig.run(3900, {1.0, 0.0, 0.0});
    EXPECT_NE(rig.driver->state(), HapticState::Ready);
    EXPECT_GT(rig.driver->counters().timeouts, 50U);
    EXPECT_EQ(glm::length(rig.peer.force_n()), 0.0);
    EXPECT_GE(rig.until(HapticState::Ready, 2000), 0);
}

TEST(RedirFalcon, UnpluggedItIsAbsentAndTheForceEnds) {
    RedirRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(100, {1.0, 0.0, 0.0});
    EXPECT_GT(glm::length(rig.peer.force_n()), 0.9);
    rig.wire.host.unplug();
    rig.run(50, {1.0, 0.0, 0.0});
    EXPECT_EQ(rig.driver->state(), HapticState::Absent);
    EXPECT_EQ(glm::length(rig.peer.force_n()), 0.0) << "the firmware's own watchdog";
    rig.wire.host.plug_in();
    EXPECT_GE(rig.until(HapticState::Ready, 1000), 0) << "its own supply kept the firmware";
}

TEST(RedirFalcon, WithoutItsSupplyTheFirmwareIsGone) {
    RedirRig rig({}, with_firmware());
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.say("power-loss");
    ASSERT_GE(rig.until(HapticState::Loading, 3000), 0);
    EXPECT_GE(rig.until(HapticState::Ready, 8000), 0);
}

TEST(RedirFalcon, RefusesOrdersThatMakeNoSense) {
    FalconPeer peer(still(), {});
    for (const char* line :
         {"", " ", "hold", "hold 1 2 3", "hold a b c", "hold nan 0 0", "press", "press 4", "press -1",
          "press 0 -5", "press 1.5", "silent", "silent 2h", "hang 1e9", "jump", "follow me"})
        EXPECT_NE(peer.command(Instant(0), line), "") << line;
    EXPECT_EQ(peer.board().buttons, 0);
}

}  // namespace
}  // namespace eddy::redir
