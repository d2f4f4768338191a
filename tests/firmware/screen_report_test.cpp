#include "firmware/screen_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/display/emulated/emulated_machine.h"

namespace eddy {
namespace {

using kms::Connection;
using testing::HasSubstr;
using testing::Not;

class ScreenReportTest : public testing::Test {
  protected:
    ScreenReport report(const kms::Wish& wish = {}) const {
        const auto seen = machine.machine();
        return report_screens(*seen, wish);
    }
    emulated::ScreenMachine machine;
};

TEST_F(ScreenReportTest, NamesPlugMonitorModesAndTheChoice) {
    const ScreenReport r = report();
    EXPECT_TRUE(r.usable);
    EXPECT_THAT(r.text, AllOf(HasSubstr("/dev/dri/card0"), HasSubstr("HDMI-A-1: connected: Hall 1"),
                              HasSubstr("1920x1080@60 (preferred), 1920x1080@50"),
                              HasSubstr("would be used: the first that is connected"),
                              HasSubstr("in 1920x1080@60: the monitor prefers it")));
}

TEST_F(ScreenReportTest, ChangesNothing) {
    const std::uint32_t console = machine.card().show_console(0);
    report();
    EXPECT_EQ(machine.card().seen_on(0), console);
    EXPECT_EQ(machine.card().modesets, 0);
    EXPECT_EQ(machine.card().master, -1);
}

TEST_F(ScreenReportTest, NamesTheProgramThatIsInTheWay) {
    machine.card().other_master = "gnome-shell (process 812)";
    const ScreenReport r = report();
    EXPECT_FALSE(r.usable);
    EXPECT_THAT(r.text, HasSubstr("held by gnome-shell (process 812)"));
}

TEST_F(ScreenReportTest, SaysHowToGetThePermission) {
    machine.card().open_error = EACCES;
    const ScreenReport r = report();
    EXPECT_FALSE(r.usable);
    EXPECT_THAT(r.text, AllOf(HasSubstr("Permission denied"), HasSubstr("usermod -aG video")));
}

TEST_F(ScreenReportTest, SaysWhyNoScreenWouldBeUsed) {
    machine.card().plugs[0].connection = Connection::Unknown;
    ScreenReport r = report();
    EXPECT_FALSE(r.usable);
    EXPECT_THAT(r.text, AllOf(HasSubstr("cannot tell"), HasSubstr("nothing is connected")));
    EXPECT_THAT(r.text, Not(HasSubstr("    would be used: ")));
    r = report({.connector = "HDMI-A-1"});
    EXPECT_TRUE(r.usable);
    r = report({.connector = "DP-3"});
    EXPECT_THAT(r.text, HasSubstr("DP-3"));
}

}  // namespace
}  // namespace eddy
