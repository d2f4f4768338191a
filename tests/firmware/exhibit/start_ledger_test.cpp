#include "firmware/exhibit/start_ledger.h"

#include <gtest/gtest.h>

#include <regex>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

constexpr std::int64_t kNoon = 1'795'000'000;

class StartLedgerTest : public testing::Test {
  protected:
    StartLedger::Verdict start(std::int64_t at_s, const std::string& boot) {
        return StartLedger(folder_.path()).begin(at_s, boot);
    }
    /// A boot in which the program fails until systemd starts the machine anew.
    void give_up(std::int64_t at_s, const std::string& boot) {
        for (int i = 0; i < StartLedger::kBurst; ++i) start(at_s + i, boot);
    }
    ScratchFolder folder_;
};

TEST_F(StartLedgerTest, KnowsHowTheRunBeforeEnded) {
    EXPECT_EQ(start(kNoon, "a").before, EndBefore::None);
    EXPECT_EQ(start(kNoon + 1, "a").before, EndBefore::Failed) << "the machine is the same";
    StartLedger ledger(folder_.path());
    ledger.begin(kNoon + 2, "a");
    ledger.end_well();
    EXPECT_EQ(start(kNoon + 3, "a").before, EndBefore::Well);
    EXPECT_EQ(start(kNoon + 60, "b").before, EndBefore::PowerLost) << "the machine went away";
}

TEST_F(StartLedgerTest, ThreeRestartsOfTheMachineInAnHourLeadToSafeMode) {
    give_up(kNoon, "a");
    EXPECT_EQ(start(kNoon + 60, "b").before, EndBefore::Failed) << "not a power cut: it gave up";
    give_up(kNoon + 61, "b");
    EXPECT_FALSE(start(kNoon + 120, "c").safe);
    give_up(kNoon + 121, "c");
    const StartLedger::Verdict verdict = start(kNoon + 180, "d");
    EXPECT_TRUE(verdict.safe);
    EXPECT_FALSE(verdict.asked_for);
    EXPECT_EQ(verdict.restarts, 3);
    EXPECT_EQ(verdict.wait_s, 0);
}

TEST_F(StartLedgerTest, InSafeModeTheMachineIsNotStartedAnewHoweverOftenTheProgramFails) {
    for (const char* boot : {"a", "b", "c"}) give_up(kNoon, boot);
    std::int64_t now = kNoon + 100;
    std::vector<std::int64_t> starts;
    for (int i = 0; i < 30; ++i) {
        const StartLedger::Verdict verdict = start(now, "d");
        ASSERT_TRUE(verdict.safe) << i;
        // systemd counts when the process starts, before it waits.
        starts.push_back(now);
        now += verdict.wait_s + 1;
    }
    for (std::size_t i = StartLedger::kBurst; i < starts.size(); ++i)
        EXPECT_GT(starts[i] - starts[i - StartLedger::kBurst], StartLedger::kBurst_s) << i;
}

TEST_F(StartLedgerTest, PowerCutsAndOrdinaryCrashesDoNotLeadToSafeMode) {
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(start(kNoon + 60 * i, "boot" + std::to_string(i)).safe) << i;
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(start(kNoon + 3000 + 100 * i, "same").safe) << i;
}

TEST_F(StartLedgerTest, WhoeverAsksForANewProcessHasNotFailedAndIsNotStartedTooOften) {
    std::vector<std::int64_t> starts;
    std::int64_t now = kNoon;
    for (int i = 0; i < 30; ++i) {
        StartLedger ledger(folder_.path());
        const StartLedger::Verdict verdict = ledger.begin(now, "a");
        ASSERT_FALSE(verdict.safe) << i;
        EXPECT_NE(verdict.before, EndBefore::Failed) << i;
        if (i < 2) {
            EXPECT_EQ(verdict.wait_s, 0) << "at once, as a rule";
        }
        starts.push_back(now);
        now += verdict.wait_s + 1;
        ledger.end_for_restart();
    }
    for (std::size_t i = StartLedger::kBurst; i < starts.size(); ++i)
        EXPECT_GT(starts[i] - starts[i - StartLedger::kBurst], StartLedger::kBurst_s) << i;
    for (const char* boot : {"b", "c", "d"})
        EXPECT_FALSE(start(now += 60, boot).safe) << "nor has the machine";
}

/// systemd counts every start, whatever the program says of its end.
TEST_F(StartLedgerTest, FailuresBetweenStartsThatWereAskedForLeadToSafeModeAsWell) {
    std::int64_t now = kNoon;
    for (const char* boot : {"a", "b", "c"}) {
        const std::int64_t first = now;
        for (const bool asks : {true, false, true, false, false}) {
            StartLedger ledger(folder_.path());
            now += ledger.begin(now, boot).wait_s + 1;
            if (asks) ledger.end_for_restart();
        }
        ASSERT_LE(now - first, StartLedger::kBurst_s) << "the next one is refused";
        now += 30;
    }
    const StartLedger::Verdict verdict = start(now, "d");
    EXPECT_EQ(verdict.before, EndBefore::Failed) << "not a power cut: it gave up";
    EXPECT_EQ(verdict.restarts, 3);
    EXPECT_TRUE(verdict.safe);
}

TEST_F(StartLedgerTest, AnHourLaterAllIsAsUsual) {
    for (const char* boot : {"a", "b", "c"}) give_up(kNoon, boot);
    EXPECT_TRUE(start(kNoon + StartLedger::kHour_s - 60, "d").safe);
    EXPECT_FALSE(start(kNoon + StartLedger::kHour_s + 60, "d").safe);
}

TEST_F(StartLedgerTest, AMachineWhoseClockBeginsAtTheSameHourEachTimeGetsOutOfSafeModeToo) {
    for (const char* boot : {"a", "b", "c"}) give_up(kNoon, boot);
    EXPECT_TRUE(start(kNoon, "d").safe);
    EXPECT_FALSE(start(kNoon, "e").safe) << "somebody has switched it off and on";
    give_up(kNoon, "f");
    const StartLedger::Verdict verdict = start(kNoon, "g");
    EXPECT_EQ(verdict.restarts, 1) << "those of long ago are over";
    EXPECT_EQ(verdict.before, EndBefore::Failed);
}

TEST_F(StartLedgerTest, AClockThatWasSetBackUndoesNothing) {
    for (const char* boot : {"a", "b", "c"}) give_up(kNoon, boot);
    const StartLedger::Verdict verdict = start(0, "d");
    EXPECT_TRUE(verdict.safe);
    EXPECT_LE(start(1, "d").wait_s, StartLedger::kSafeStep_s);
}

TEST_F(StartLedgerTest, AFileAsksForSafeMode) {
    folder_.write("safe", "");
    EXPECT_TRUE(start(kNoon, "a").safe);
    EXPECT_TRUE(start(kNoon + 1, "a").asked_for);
}

TEST_F(StartLedgerTest, WhateverTheFileHoldsTheProgramStarts) {
    give_up(kNoon, "a");
    const std::string whole = read_all(folder_ / "starts");
    for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
        folder_.write("starts", whole.substr(0, cut));
        EXPECT_FALSE(start(kNoon + 10, "b").safe) << cut;
    }
    StateFile(folder_ / "starts").write(std::string("\0\xff garbage\n7 a well more\nx a well\n", 32));
    EXPECT_EQ(start(kNoon, "a").before, EndBefore::None);
}

TEST_F(StartLedgerTest, AStateFolderThatIsGoneDoesNotStopTheShow) {
    folder_.write("no_folder", "");
    const StartLedger::Verdict verdict = StartLedger(folder_ / "no_folder").begin(kNoon, "a");
    EXPECT_FALSE(verdict.safe);
    EXPECT_FALSE(verdict.written);
}

TEST_F(StartLedgerTest, ForgetsOldStarts) {
    for (int i = 0; i < 200; ++i) start(kNoon + i * 4000, "boot");
    EXPECT_LT(read_all(folder_ / "starts").size(), 4000U);
}

/// What the ledger takes for granted of systemd.
TEST(StartLedgerUnit, HasTheLimitsOfTheService) {
    const std::string unit = read_all(EDDY_SOURCE_DIR "/systemd/eddy.service");
    std::smatch m;
    ASSERT_TRUE(std::regex_search(unit, m, std::regex("\nStartLimitBurst=(\\d+)\n")));
    EXPECT_EQ(std::stoi(m[1]), StartLedger::kBurst);
    ASSERT_TRUE(std::regex_search(unit, m, std::regex("\nStartLimitIntervalSec=(\\d+)\n")));
    EXPECT_EQ(std::stoi(m[1]), StartLedger::kBurst_s);
}

TEST(BootId, IsTheSameAllAlong) {
    EXPECT_EQ(boot_id(), boot_id());
    EXPECT_FALSE(boot_id().empty());
}

}  // namespace
}  // namespace eddy
