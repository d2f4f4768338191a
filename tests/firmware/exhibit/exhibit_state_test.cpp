#include "firmware/exhibit/exhibit_state.h"

#include <gtest/gtest.h>

namespace eddy {
namespace {

const ExhibitFacts kWell{
    .first_frame = true, .has_device = true, .device = HapticState::Ready, .force = GateReason::Open};

TEST(ExhibitState, IsAttractUntilSomebodyComes) {
    ExhibitFacts facts = kWell;
    EXPECT_EQ(exhibit_state(facts), ExhibitState::Attract);
    EXPECT_EQ(lamp_code(facts), LampCode::Attract);
    facts.presence = Presence::Here;
    EXPECT_EQ(exhibit_state(facts), ExhibitState::InUse);
    EXPECT_EQ(lamp_code(facts), LampCode::HandOn);
    facts.force = GateReason::Released;
    EXPECT_EQ(lamp_code(facts), LampCode::Show) << "somebody is here, but nobody holds the handle";
}

TEST(ExhibitState, IsStartingBeforeItsFirstFrameWhateverElseIsSo) {
    ExhibitFacts facts = kWell;
    facts.first_frame = false;
    facts.force = GateReason::Stopped;
    facts.safe = true;
    EXPECT_EQ(exhibit_state(facts), ExhibitState::Starting);
    EXPECT_EQ(lamp_code(facts), LampCode::Starting);
}

TEST(ExhibitState, IsReadyWithItsFirstPictureOrWhereNoneIsWanted) {
    using namespace std::chrono_literals;
    EXPECT_FALSE(is_ready({.has_screen = true, .played = 1s}));
    EXPECT_TRUE(is_ready({.shown = true, .has_screen = true}));
    EXPECT_TRUE(is_ready({.has_screen = false})) << "there may never be one";
    EXPECT_TRUE(is_ready({.has_screen = true, .open = false})) << "switched on at night";
    EXPECT_TRUE(is_ready({.has_screen = true, .played = 2s})) << "another program has the screen";
}

TEST(ExhibitState, ClosedIsNoFailure) {
    ExhibitFacts facts = kWell;
    facts.open = false;
    facts.device = HapticState::Absent;
    EXPECT_EQ(exhibit_state(facts), ExhibitState::Closed);
    EXPECT_EQ(lamp_code(facts), LampCode::Closed);
}

TEST(ExhibitState, EachThingThatIsMissingDegrades) {
    for (const auto spoil :
         {+[](ExhibitFacts& f) { f.device = HapticState::Absent; },
          +[](ExhibitFacts& f) { f.device = HapticState::Homing; },
          +[](ExhibitFacts& f) { f.force = GateReason::DeviceSilent; },
          +[](ExhibitFacts& f) { f.has_screen = false; }, +[](ExhibitFacts& f) { f.button_stuck = true; },
          +[](ExhibitFacts& f) { f.fell_back = true; }, +[](ExhibitFacts& f) { f.files_wait = true; }}) {
        ExhibitFacts facts = kWell;
        spoil(facts);
        EXPECT_EQ(exhibit_state(facts), ExhibitState::Degraded);
        EXPECT_EQ(lamp_code(facts), LampCode::Degraded);
    }
    ExhibitFacts to_be_watched = kWell;
    to_be_watched.has_device = false;
    to_be_watched.device = HapticState::Absent;
    EXPECT_EQ(exhibit_state(to_be_watched), ExhibitState::Attract) << "no hand was ordered";
}

TEST(ExhibitState, AStopIsTheLampsFirstConcern) {
    ExhibitFacts facts = kWell;
    facts.force = GateReason::Stopped;
    EXPECT_EQ(exhibit_state(facts), ExhibitState::Degraded);
    EXPECT_EQ(lamp_code(facts), LampCode::Stopped);
}

TEST(ExhibitState, ADeviceInFaultAndSafeModeCallForSomebody) {
    ExhibitFacts facts = kWell;
    facts.device = HapticState::Fault;
    EXPECT_EQ(exhibit_state(facts), ExhibitState::Fault);
    EXPECT_EQ(lamp_code(facts), LampCode::Fault);
    facts = kWell;
    facts.safe = true;
    EXPECT_EQ(exhibit_state(facts), ExhibitState::Safe);
    EXPECT_EQ(lamp_code(facts), LampCode::Fault);
}

}  // namespace
}  // namespace eddy
