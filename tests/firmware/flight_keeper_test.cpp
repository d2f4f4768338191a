#include "firmware/flight_keeper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <fstream>

#include "firmware/haptic/flight_file.h"
#include "firmware/haptic/flight_rerun.h"
#include "firmware/text_file.h"
#include "tests/firmware/haptic/loop_rig.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using testing::HasSubstr;

void stop_it(LoopRig& rig) {
    rig.run(2000);
    rig.orders.stop = true;
    rig.order();
    rig.run(700);
}

TEST(FlightKeeper, WritesAFlightThatRunsAgainBitForBit) {
    const ScratchFolder folder;
    LoopRig rig;
    FlightKeeper keeper(rig.flights, folder.path() / "flights");
    stop_it(rig);
    keeper.finish();
    const auto files = flights_in(folder.path() / "flights");
    ASSERT_EQ(files.size(), 1U);
    EXPECT_THAT(files[0].filename().string(), HasSubstr("-stopped.flight"));
    EXPECT_EQ(keeper.kept(), 1U);
    EXPECT_THAT(keeper.news().value_or(""), HasSubstr(files[0].string()));
    EXPECT_FALSE(keeper.news());
    const Flight flight = read_flight(read_text_file(files[0]), files[0].string());
    EXPECT_EQ(flight.version, EDDY_VERSION);
    EXPECT_EQ(flight.ticks.size(), 2501U);
    EXPECT_EQ(rerun(flight).differing, 0U);
}

TEST(FlightKeeper, KeepsTwentyAndTheOldestGoFirst) {
    const ScratchFolder folder;
    for (int day = 10; day < 35; ++day)
        std::ofstream(folder.path() / fmt::format("202601{}T000000Z-stopped.flight", day)) << "old";
    std::ofstream(folder.path() / "notes.txt") << "not a flight";
    LoopRig rig;
    {
        FlightKeeper keeper(rig.flights, folder.path());
        stop_it(rig);
    }
    const auto files = flights_in(folder.path());
    ASSERT_EQ(files.size(), FlightKeeper::kMostFiles);
    EXPECT_GT(std::filesystem::file_size(files.front()), 1000U) << "the newest is the one just written";
    EXPECT_EQ(files.back().filename(), "20260116T000000Z-stopped.flight");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "notes.txt"));
}

TEST(FlightKeeper, WhatTheLogNamesIsThereThoughTheClockHasGoneBack) {
    const ScratchFolder folder;
    for (int day = 10; day < 30; ++day)
        std::ofstream(folder.path() / fmt::format("209901{}T000000Z-stopped.flight", day)) << "later";
    LoopRig rig;
    FlightKeeper keeper(rig.flights, folder.path());
    stop_it(rig);
    keeper.finish();
    const auto files = flights_in(folder.path());
    ASSERT_EQ(files.size(), FlightKeeper::kMostFiles);
    EXPECT_THAT(keeper.news().value_or(""), HasSubstr(files.back().string()));
    EXPECT_GT(std::filesystem::file_size(files.back()), 1000U);
}

TEST(FlightKeeper, AFolderThatCannotBeDoesNotStopTheShow) {
    const ScratchFolder folder;
    std::ofstream(folder.path() / "file") << "x";
    LoopRig rig;
    FlightKeeper keeper(rig.flights, folder.path() / "file");
    stop_it(rig);
    keeper.finish();
    EXPECT_EQ(keeper.kept(), 0U);
    EXPECT_THAT(keeper.news().value_or(""), HasSubstr("could not be kept"));
}

}  // namespace
}  // namespace eddy
