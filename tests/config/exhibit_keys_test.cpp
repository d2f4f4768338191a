#include "config/exhibit_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/unit.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ExhibitKeys, TellWhichChangedAndWhenThatCounts) {
    Exhibit next;
    EXPECT_THAT(changed_keys({}, next), IsEmpty());
    next.scene = "stir";
    next.max_force_n = 2.0;
    next.falcon.serial = "F";
    EXPECT_THAT(changed_keys({}, next),
                ElementsAre(KeyChange{"scene", TakesEffect::Scene, "\"jet\"", "\"stir\""},
                            KeyChange{"max_force_n", TakesEffect::Live, "4", "2"},
                            KeyChange{"falcon.serial", TakesEffect::Process, "\"\"", "\"F\""}));
}

TEST(ExhibitKeys, WhatNeedsARestartStaysAsItRuns) {
    Exhibit runs, next;
    runs.haptics = HapticsChoice::Emulated;
    next.scene = "stir";
    next.max_force_n = 2.0;
    next.falcon.serial = "F";
    next.run_dir = "/elsewhere";
    const Exhibit now = without_restart(runs, next);
    EXPECT_THAT(changed_keys(runs, now), testing::SizeIs(2));
    EXPECT_EQ(now.scene, "stir");
    EXPECT_EQ(now.max_force_n, 2.0);
    EXPECT_EQ(now.haptics, HapticsChoice::Emulated);
    EXPECT_EQ(now.falcon, runs.falcon);
    EXPECT_EQ(now.run_dir, runs.run_dir);
}

TEST(ExhibitKeys, KeysOfExhibitsAndOfScenesAreToldApart) {
    EXPECT_TRUE(is_exhibit_key("presets"));
    EXPECT_TRUE(is_exhibit_table("falcon"));
    EXPECT_FALSE(is_exhibit_table("haptics"));
    EXPECT_FALSE(is_exhibit_key("body"));
}

TEST(Unit, IsAtTheEndOfTheKey) {
    EXPECT_EQ(unit_of("preset_s"), "s");
    EXPECT_EQ(unit_of("velocity_m_s"), "m/s");
    EXPECT_EQ(unit_of("max_force_n"), "N");
    EXPECT_EQ(unit_of("scene"), "");
    EXPECT_EQ(unit_of("presets"), "");
}

}  // namespace
}  // namespace eddy
