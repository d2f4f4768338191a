#include "hal/display/kms/kms_display.h"

#include <drm_fourcc.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/display/kms/rig.h"

// What can happen to a screen in a hall, a test a line: who has the card, which plug and mode, and what comes and goes.

namespace eddy::kms {
namespace {

using namespace std::chrono_literals;
using emulated::make_edid;
using emulated::make_mode;
using emulated::Plug;
using testing::HasSubstr;

class KmsDisplayTest : public testing::Test, public Rig {
  protected:
    void TearDown() override {
        EXPECT_EQ(card().commits_too_early, 0) << "something was asked of the card while a flip was pending";
    }
    std::string mode_on(std::uint32_t crtc = emulated::GraphicsCard::kFirstCrtc) const {
        const auto& mode = card().crtcs.at(crtc).mode;
        return mode ? describe(*mode) : "none";
    }
};

// ------------------------------------------------------------------------------------------- the usual day

TEST_F(KmsDisplayTest, ShowsSixtyFramesASecondOnAScreenOfSixtyHertz) {
    open();
    EXPECT_EQ(state, DisplayState::Showing);
    run(1s);
    EXPECT_NEAR(static_cast<double>(rate()), 60.0, 1.0);
    EXPECT_EQ(mode_on(), "1920x1080@60");
    EXPECT_EQ(display->size_px(), (SizePx{1920, 1080}));
    EXPECT_NE(card().seen_on(0), 0U);
    EXPECT_EQ(display->counters().modesets, 1);
    EXPECT_EQ(display->counters().late, 0);
    EXPECT_EQ(display->problem(), "");
    EXPECT_THAT(display->describe(), HasSubstr("HDMI-A-1 of /dev/dri/card0 (Hall 1), 1920x1080@60"));
}

TEST_F(KmsDisplayTest, AsksWhetherAModeIsPossibleBeforeItSetsIt) {
    open();
    run(100ms);
    EXPECT_EQ(card().tests, 1);
}

TEST_F(KmsDisplayTest, AFrameThatIsReadyTooSoonTakesThePlaceOfTheOneThatWaits) {
    open();
    run(100ms);
    const DisplayCounters before = display->counters();
    for (int i = 0; i < 1000; ++i) {  // a show that draws a thousand frames a second, wanted or not
        machine.wait(1ms);
        display->poll(machine.now());
        display->present();
    }
    const DisplayCounters after = display->counters();
    EXPECT_NEAR(static_cast<double>(after.flips - before.flips), 60.0, 1.0);
    EXPECT_NEAR(static_cast<double>(after.replaced - before.replaced), 940.0, 2.0);
}

TEST_F(KmsDisplayTest, GlAlwaysHasABufferToDrawIntoEvenOfThree) {
    card().buffers = 3;
    open();
    for (int i = 0; i < 200; ++i) {
        machine.wait(1ms);
        display->poll(machine.now());
        display->present();  // one that GL could not draw would not be there
    }
    const DisplayCounters c = display->counters();
    EXPECT_EQ(c.flips + c.replaced, 199) << "each but the one that is on its way";
}

TEST_F(KmsDisplayTest, WhatWasOnTheScreenIsPutBackAtTheEnd) {
    const std::uint32_t console = card().show_console(0);
    open();
    run(1s);
    EXPECT_NE(card().seen_on(0), console);
    EXPECT_FALSE(machine.console_text());
    display.reset();
    EXPECT_EQ(card().seen_on(0), console);
    EXPECT_TRUE(machine.console_text());
    EXPECT_EQ(card().framebuffers.size(), 1U) << "and nothing of ours stays";
    EXPECT_TRUE(card().mode_blobs.empty());
}

TEST_F(KmsDisplayTest, AScreenThatWasDarkAtTheStartIsDarkAtTheEnd) {
    open();
    run(1s);
    display.reset();
    EXPECT_EQ(card().seen_on(0), 0U);
    EXPECT_EQ(mode_on(), "none");
}

TEST_F(KmsDisplayTest, APictureThatIsGoneAtTheEndLeavesTheScreenToTheKernel) {
    const std::uint32_t splash = card().show_console(0);
    open();
    run(1s);
    card().framebuffers.erase(splash);
    display.reset();
    EXPECT_EQ(mode_on(), "none");
}

// ------------------------------------------------------------------------------------------ who has the card

TEST_F(KmsDisplayTest, WithoutACardItSaysSo) {
    emulated::ScreenMachine none;
    none.card().open_error = EACCES;
    try {
        KmsDisplay refused(none.machine(), {});
        FAIL();
    } catch (const KmsError& e) {
        EXPECT_THAT(e.what(), AllOf(HasSubstr("/dev/dri/card0"), HasSubstr("video")));
    }
}

TEST_F(KmsDisplayTest, NamesTheProgramThatHasTheScreenAndTakesItWithinASecondOfItsEnd) {
    card().other_master = "plymouthd (process 231)";
    open();
    run(5s);
    EXPECT_EQ(state, DisplayState::NoMonitor);
    EXPECT_THAT(display->problem(), HasSubstr("plymouthd (process 231)"));
    EXPECT_EQ(card().modesets, 0);
    card().other_master.clear();
    EXPECT_LE(until(DisplayState::Showing, 5s), 1100ms);
    EXPECT_GT(rate(), 50);
    EXPECT_EQ(display->problem(), "");
}

TEST_F(KmsDisplayTest, AScreenThatIsTakenAwayIsTakenBack) {
    open();
    run(1s);
    card().other_master = "another";
    card().master = -1;
    until(DisplayState::NoMonitor, 1s);
    EXPECT_EQ(state, DisplayState::NoMonitor);
    EXPECT_EQ(display->counters().master_lost, 1);
    card().other_master.clear();
    EXPECT_LE(until(DisplayState::Showing, 5s), 1100ms);
    EXPECT_GT(rate(), 50);
    EXPECT_EQ(display->counters().reopenings, 0);
}

TEST_F(KmsDisplayTest, OfTwoCardsTheOneWithAScreenIsTaken) {
    card().plugs[0].connection = Connection::Disconnected;
    machine.add_card();
    open();
    run(1s);
    EXPECT_EQ(state, DisplayState::Showing);
    EXPECT_NE(card(1).seen_on(0), 0U);
    EXPECT_EQ(card(0).master, -1) << "the other is left to others";
}

TEST_F(KmsDisplayTest, ACardWithoutPlugsIsNoneAtAll) {
    card().plugs.clear();
    EXPECT_THROW(open(), KmsError);
    machine.add_card();
    open();
    EXPECT_EQ(state, DisplayState::Showing);
}

TEST_F(KmsDisplayTest, ACardThatComesUpLateIsNoticed) {
    card().plugs.clear();
    machine.add_card().open_error = EACCES;  // as long as udev has not got round to it
    EXPECT_FALSE(has_card(*machine.machine()));
    card(1).open_error = 0;
    EXPECT_TRUE(has_card(*machine.machine()));
    EXPECT_EQ(card(1).master, -1) << "a look takes nothing";
    card(1).plugs[0].connection = Connection::Disconnected;
    EXPECT_TRUE(has_card(*machine.machine())) << "a screen may come later still";
}

TEST_F(KmsDisplayTest, AScreenThatMovesToAnotherCardNeedsANewProcess) {
    machine.add_card().plugs[0].connection = Connection::Disconnected;
    open();
    run(1s);
    card(0).plugs[0].connection = Connection::Disconnected;
    card(1).plugs[0].connection = Connection::Connected;
    machine.tell_of_plugs();
    EXPECT_LE(until(DisplayState::Moved, 5s), 600ms);
    run(1s);
    EXPECT_EQ(state, DisplayState::Moved);
    EXPECT_THAT(display->problem(), HasSubstr("/dev/dri/card1"));
    display.reset();
    open();
    EXPECT_EQ(state, DisplayState::Showing);
}

// ---------------------------------------------------------------------------------------- which plug and mode

TEST_F(KmsDisplayTest, ThePlugAndTheModeThatAreWishedAreTaken) {
    card().plugs.push_back({.name = "DP-1"});
    wish = {.connector = "DP-1", .mode = "1280x720@60"};
    open();
    run(1s);
    EXPECT_NE(card().seen_on(1), 0U);
    EXPECT_EQ(card().seen_on(0), 0U);
    EXPECT_EQ(display->size_px(), (SizePx{1280, 720}));
}

TEST_F(KmsDisplayTest, APlugThatDoesNotExistIsNamedWithThoseThatDo) {
    wish = {.connector = "DP-7"};
    open();
    EXPECT_EQ(state, DisplayState::NoMonitor);
    EXPECT_THAT(display->problem(), AllOf(HasSubstr("DP-7"), HasSubstr("HDMI-A-1")));
}

TEST_F(KmsDisplayTest, AMonitorWithoutEdidShowsWhatTheKernelThinksItCan) {
    card().plugs[0].edid.clear();
    card().plugs[0].modes = {make_mode(1024, 768, 60.0)};
    open();
    run(1s);
    EXPECT_EQ(mode_on(), "1024x768@60");
    EXPECT_EQ(display->screen_id(), "");
}

TEST_F(KmsDisplayTest, APlugOfUnknownStateIsDrivenWhenItIsNamed) {
    card().plugs[0].connection = Connection::Unknown;
    card().plugs[0].edid.clear();
    open();
    EXPECT_EQ(state, DisplayState::NoMonitor);
    display.reset();
    wish.connector = "HDMI-A-1";
    open();
    run(1s);
    EXPECT_EQ(state, DisplayState::Showing);
    EXPECT_EQ(mode_on(), "1920x1080@60");
}

TEST_F(KmsDisplayTest, AModeThatTheCardRefusesGivesWayToTheNext) {
    card().refuses = {"1920x1080@60"};
    open();
    run(1s);
    EXPECT_EQ(mode_on(), "1280x720@60");
    EXPECT_EQ(display->size_px(), (SizePx{1280, 720}));
    EXPECT_GT(rate(), 50);
}

TEST_F(KmsDisplayTest, ACardThatRefusesEveryModeIsSaidToAndTriedAgain) {
    card().refuses = {"1920x1080@60", "1280x720@60", "640x480@60"};
    open();
    until(DisplayState::NoMonitor, 5s);
    EXPECT_EQ(state, DisplayState::NoMonitor);
    EXPECT_THAT(display->problem(), HasSubstr("refuses every mode"));
    card().refuses.clear();
    EXPECT_LE(until(DisplayState::Showing, 20s), 11s);
    EXPECT_GT(rate(), 50);
}

// -------------------------------------------------------------------------------- commits, buffers, pacing

TEST_F(KmsDisplayTest, ADriverWithoutAtomicCommitsGetsTheOlderCalls) {
    card().has_atomic = false;
    open();
    run(1s);
    EXPECT_NEAR(static_cast<double>(rate()), 60.0, 1.0);
    EXPECT_THAT(display->describe(), HasSubstr("older calls"));
}

TEST_F(KmsDisplayTest, ADriverWhoseAtomicCommitsFailGetsTheOlderCallsInTheSameMode) {
    card().refuses_atomic = true;
    open();
    run(1s);
    EXPECT_EQ(mode_on(), "1920x1080@60");
    EXPECT_NEAR(static_cast<double>(rate()), 60.0, 1.0);
    EXPECT_THAT(display->describe(), HasSubstr("older calls"));
}

TEST_F(KmsDisplayTest, PicturesAreTiledWhereCardAndDriverAgree) {
    open();
    run(1s);
    EXPECT_NE(card().framebuffers.at(card().seen_on(0)).modifier, DRM_FORMAT_MOD_INVALID);
    EXPECT_EQ(card().framebuffers.at(card().seen_on(0)).format, DRM_FORMAT_XRGB8888);
}

TEST_F(KmsDisplayTest, PicturesAreAsTheDriverLikesWhereTheyCannotBeTiled) {
    card().refuses_modifiers = true;
    open();
    run(1s);
    EXPECT_EQ(card().framebuffers.at(card().seen_on(0)).modifier, DRM_FORMAT_MOD_INVALID);
    EXPECT_GT(rate(), 50);
}

TEST_F(KmsDisplayTest, AndLinearWhereNothingElseGoes) {
    card().has_modifiers = false;
    card().no_layouts = {Layout::Modifiers, Layout::Own};
    open();
    EXPECT_GT(rate(), 50);
}

TEST_F(KmsDisplayTest, OfTheTwoFormatsOneIsEnough) {
    card().no_formats = {DRM_FORMAT_XRGB8888};
    open();
    run(1s);
    EXPECT_EQ(card().framebuffers.at(card().seen_on(0)).format, DRM_FORMAT_ARGB8888);
}

TEST_F(KmsDisplayTest, AWindowThatGlCannotUseGivesWayToAnotherKind) {
    open();
    const long before = display->window_number();
    display->refuse_window();
    EXPECT_NE(display->window_number(), before);
    run(1s);
    EXPECT_GT(rate(), 50);
    for (int i = 0; i < 100; ++i) display->refuse_window();
    state = display->poll(machine.now());
    EXPECT_EQ(state, DisplayState::NoMonitor);
    EXPECT_EQ(display->size_px(), std::nullopt);
}

TEST_F(KmsDisplayTest, PacesItselfWhereTheDriverDoesNot) {
    card().flip_takes = 10130us;  // virtio-gpu: 98.7 frames a second
    card().plugs[0].modes = {make_mode(1280, 720, 75.0, true)};
    open();
    run(2s, 1ms);
    const long before = flips();
    run(10s, 1ms);
    EXPECT_NEAR(static_cast<double>(flips() - before) / 10.0, 75.0, 1.0);
}

TEST_F(KmsDisplayTest, LateFramesAreCounted) {
    card().flip_takes = 30ms;
    open();
    run(3s);
    EXPECT_GT(display->counters().late, 50);
}

// ------------------------------------------------------------------------------------------------ the ladder

TEST_F(KmsDisplayTest, FramesThatDoNotComeForThreeSecondsComeAgainAfterAModeset) {
    open();
    run(1s);
    card().loses_flips_at_reset = true;
    run(2900ms);
    EXPECT_EQ(display->counters().recoveries, 0);
    run(300ms);
    EXPECT_EQ(display->counters().recoveries, 1);
    EXPECT_GT(rate(), 50);
    EXPECT_EQ(display->problem(), "");
    EXPECT_EQ(state, DisplayState::Showing);
    EXPECT_EQ(display->counters().reopenings, 0);
}

TEST_F(KmsDisplayTest, OrAfterTheCardIsOpenedAgain) {
    open();
    run(1s);
    const long window = display->window_number();
    card().loses_flips_at_open = true;
    run(6500ms);
    EXPECT_EQ(display->counters().recoveries, 1);
    EXPECT_EQ(display->counters().reopenings, 1);
    EXPECT_NE(display->window_number(), window);
    EXPECT_GT(rate(), 50);
    EXPECT_EQ(state, DisplayState::Showing);
}

TEST_F(KmsDisplayTest, OrNeverAndThenItGivesUpAfterNineSeconds) {
    open();
    run(1s);
    card().loses_flips = true;
    const Instant took = until(DisplayState::Lost, 20s);
    EXPECT_NEAR(Seconds(took).count(), 9.0, 0.2);
    EXPECT_THAT(display->problem(), HasSubstr("restart"));
    EXPECT_FALSE(display->wants_frame());
    run(1s);
    EXPECT_EQ(state, DisplayState::Lost);
}

TEST_F(KmsDisplayTest, ACardThatIsGoneIsGivenUpWhenItCannotBeOpenedAgain) {
    open();
    run(1s);
    card().loses_flips = true;
    card().open_error = ENODEV;
    EXPECT_LE(until(DisplayState::Lost, 20s), 6200ms);
}

TEST_F(KmsDisplayTest, AfterTheCardWasOpenedAgainTheFirstStateIsStillPutBack) {
    const std::uint32_t console = card().show_console(0);
    open();
    run(1s);
    card().loses_flips_at_open = true;
    run(10s);
    display.reset();
    EXPECT_EQ(card().seen_on(0), console);
    EXPECT_EQ(card().framebuffers.size(), 1U);
}

TEST_F(KmsDisplayTest, ADriverThatHangsIsLeftToTheNextProcess) {
    open();
    run(1s);
    card().hangs = true;
    EXPECT_NEAR(Seconds(until(DisplayState::Lost, 20s)).count(), 9.0, 0.2);
    EXPECT_GT(card().commits_too_early, 0) << "the ladder tries, and waits for nothing";
    display.reset();
    card().hangs = false;
    open();
    EXPECT_GT(rate(), 50);
    card().commits_too_early = 0;
}

// ----------------------------------------------------------------------------------- monitors that come and go

TEST_F(KmsDisplayTest, WithoutAMonitorAtBootTheShowGoesOnAndAttachesWhenOneAppears) {
    card().plugs[0].connection = Connection::Disconnected;
    open();
    run(5s);
    EXPECT_EQ(state, DisplayState::NoMonitor);
    EXPECT_FALSE(display->wants_frame());
    EXPECT_THAT(display->problem(), HasSubstr("HDMI-A-1"));
    card().plugs[0].connection = Connection::Connected;
    machine.tell_of_plugs();
    const Instant took = until(DisplayState::Showing, 5s);
    EXPECT_GE(took, 500ms) << "a plug going in makes several changes";
    EXPECT_LE(took, 600ms);
    EXPECT_GT(rate(), 50);
    EXPECT_EQ(display->counters().hot_plugs, 1);
}

TEST_F(KmsDisplayTest, AMonitorThatNobodyToldOfIsFoundWithinTenSeconds) {
    card().plugs[0].connection = Connection::Disconnected;
    open();
    run(15s);
    card().plugs[0].connection = Connection::Connected;
    EXPECT_LE(until(DisplayState::Showing, 20s), 10100ms);
}

TEST_F(KmsDisplayTest, PlugsAreNotAskedWhileAPictureIsShown) {
    open();
    run(100ms);
    const int before = card().probes;
    run(60s);
    EXPECT_EQ(card().probes, before) << "it takes a tenth of a second, in which the picture stands";
}

TEST_F(KmsDisplayTest, AMonitorThatGoesAndComesIsShownOnAgain) {
    open();
    for (int i = 0; i < 100; ++i) {
        run(1s);
        card().plugs[0].connection = Connection::Disconnected;
        machine.tell_of_plugs();
        ASSERT_LE(until(DisplayState::NoMonitor, 5s), 600ms) << i;
        EXPECT_EQ(mode_on(), "none") << "nothing is driven";
        EXPECT_EQ(display->size_px(), std::nullopt);
        card().plugs[0].connection = Connection::Connected;
        machine.tell_of_plugs();
        ASSERT_LE(until(DisplayState::Showing, 5s), 600ms) << i;
    }
    EXPECT_GT(rate(), 50);
    EXPECT_LE(card().framebuffers.size(), 4U) << "nothing heaps up";
    EXPECT_EQ(display->counters().hot_plugs, 200);
    EXPECT_EQ(display->counters().recoveries, 0);
}

TEST_F(KmsDisplayTest, ABurstOfChangesIsLookedIntoOnce) {
    open();
    run(1s);
    for (int i = 0; i < 20; ++i) {
        machine.tell_of_plugs();
        run(100ms);
    }
    run(1s);
    EXPECT_EQ(display->counters().hot_plugs, 1);
    EXPECT_EQ(display->counters().modesets, 1) << "and nothing had changed";
}

TEST_F(KmsDisplayTest, AnotherMonitorOnThePlugGetsItsOwnMode) {
    open();
    run(1s);
    const std::string id = display->screen_id();
    card().plugs[0].edid = make_edid("Hall 2");
    card().plugs[0].modes = {make_mode(1280, 1024, 60.0, true)};
    machine.tell_of_plugs();
    run(1s);
    EXPECT_EQ(mode_on(), "1280x1024@60");
    EXPECT_EQ(display->size_px(), (SizePx{1280, 1024}));
    EXPECT_NE(display->screen_id(), id);
    EXPECT_GT(rate(), 50);
}

TEST_F(KmsDisplayTest, ALinkThatWentBadGetsItsModeSetAgain) {
    open();
    run(1s);
    card().plugs[0].link_bad = true;
    machine.tell_of_plugs();
    run(1s);
    EXPECT_FALSE(card().plugs[0].link_bad);
    EXPECT_EQ(display->counters().modesets, 2);
    EXPECT_GT(rate(), 50);
}

TEST_F(KmsDisplayTest, WhenTheScreenGoesAnotherOneIsTaken) {
    card().plugs.push_back({.name = "DP-1", .edid = make_edid("Hall 2")});
    open();
    run(1s);
    card().plugs[0].connection = Connection::Disconnected;
    machine.tell_of_plugs();
    run(1s);
    EXPECT_EQ(state, DisplayState::Showing);
    EXPECT_NE(card().seen_on(1), 0U);
    card().plugs[0].connection = Connection::Connected;
    machine.tell_of_plugs();
    run(1s);
    EXPECT_NE(card().seen_on(1), 0U) << "and stays";
}

TEST_F(KmsDisplayTest, TheScreenOfLastTimeIsFoundOnAnotherPlug) {
    card().plugs.push_back({.name = "DP-1", .edid = make_edid("Hall 2")});
    wish.connector = "DP-1";
    open();
    const std::string id = display->screen_id();
    display.reset();
    wish = {.last_used = id};
    open();
    run(100ms);
    EXPECT_NE(card().seen_on(1), 0U);
}

// --------------------------------------------------------------------------------------------------- night

TEST_F(KmsDisplayTest, ClosedMeansDarkAndOpenMeansLight) {
    for (const bool atomic : {true, false}) {
        card().has_atomic = atomic;
        open();
        run(1s);
        display->set_awake(false);
        run(8h, 10s);
        EXPECT_EQ(state, DisplayState::Asleep);
        EXPECT_EQ(card().seen_on(0), 0U);
        EXPECT_FALSE(display->wants_frame());
        EXPECT_EQ(display->counters().recoveries, 0);
        display->set_awake(true);
        EXPECT_LE(until(DisplayState::Showing, 5s), 100ms);
        EXPECT_NE(card().seen_on(0), 0U);
        EXPECT_GT(rate(), 50);
        display.reset();
    }
}

TEST_F(KmsDisplayTest, ADriverThatKnowsNoSleepEndsTheModeForTheNight) {
    for (const bool atomic : {true, false}) {
        card().has_atomic = atomic;
        card().cannot_sleep = true;
        open();
        run(1s);
        display->set_awake(false);
        run(1s);
        EXPECT_EQ(state, DisplayState::Asleep);
        EXPECT_EQ(card().seen_on(0), 0U);
        EXPECT_EQ(display->problem(), "");
        display->set_awake(true);
        EXPECT_LE(until(DisplayState::Showing, 5s), 100ms);
        EXPECT_NE(card().seen_on(0), 0U);
        EXPECT_GT(rate(), 50);
        display.reset();
    }
}

TEST_F(KmsDisplayTest, AScreenThatCannotBeSwitchedOffIsToldOfAndTriedAgain) {
    for (const bool atomic : {true, false}) {
        card().has_atomic = atomic;
        card().cannot_sleep = card().cannot_end = true;
        open();
        run(1s);
        display->set_awake(false);
        run(1min, 1s);
        EXPECT_NE(card().seen_on(0), 0U);
        EXPECT_THAT(display->problem(), HasSubstr("cannot be switched off"));
        card().cannot_sleep = card().cannot_end = false;
        run(1min, 1s);
        EXPECT_EQ(card().seen_on(0), 0U);
        EXPECT_EQ(display->problem(), "");
        display->set_awake(true);
        EXPECT_LE(until(DisplayState::Showing, 5s), 100ms);
        EXPECT_GT(rate(), 50);
        display.reset();
    }
}

TEST_F(KmsDisplayTest, ATelevisionThatLetsGoOfItsPlugAtNightIsNotAsked) {
    open();
    run(1s);
    display->set_awake(false);
    run(1s);
    card().plugs[0].connection = Connection::Disconnected;
    machine.tell_of_plugs();
    run(1h, 1s);
    EXPECT_EQ(state, DisplayState::Asleep);
    EXPECT_EQ(display->counters().hot_plugs, 0);
    card().plugs[0].connection = Connection::Connected;
    display->set_awake(true);
    EXPECT_LE(until(DisplayState::Showing, 5s), 100ms);
}

TEST_F(KmsDisplayTest, AScreenThatDoesNotWakeIsTriedEveryHalfMinuteAndReportedAfterTenMinutes) {
    open();
    run(1s);
    display->set_awake(false);
    run(1s);
    card().loses_flips = true;
    display->set_awake(true);
    run(9min + 50s);
    EXPECT_EQ(state, DisplayState::NoMonitor);
    EXPECT_NEAR(static_cast<double>(display->counters().wake_retries), 19.0, 1.0);
    EXPECT_THAT(display->problem(), testing::Not(HasSubstr("10 min")));
    run(1min);
    EXPECT_THAT(display->problem(), HasSubstr("has not woken up for 10 min"));
    EXPECT_NE(state, DisplayState::Lost) << "the show goes on";
    card().loses_flips = false;
    EXPECT_LE(until(DisplayState::Showing, 40s), 31s);
    EXPECT_EQ(display->problem(), "");
}

TEST_F(KmsDisplayTest, ATelevisionThatIsStillStartingIsWaitedFor) {
    open();
    run(1s);
    display->set_awake(false);
    run(1s);
    card().plugs[0].edid.clear();
    display->set_awake(true);
    run(20s);
    EXPECT_EQ(state, DisplayState::NoMonitor) << "it does not say who it is yet";
    card().plugs[0].edid = make_edid("Hall 1");
    EXPECT_LE(until(DisplayState::Showing, 40s), 12s);
}

TEST_F(KmsDisplayTest, AScreenThatIsClosedFromTheStartStaysDark) {
    card().show_console(0);
    open();
    display->set_awake(false);
    run(1s);
    EXPECT_EQ(state, DisplayState::Asleep);
    EXPECT_EQ(card().seen_on(0), 0U) << "no console either";
    display->set_awake(true);
    until(DisplayState::Showing, 5s);
    EXPECT_GT(rate(), 50);
}

}  // namespace
}  // namespace eddy::kms
