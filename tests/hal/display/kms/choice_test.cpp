#include "hal/display/kms/choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/display/emulated/emulated_card.h"

namespace eddy::kms {
namespace {

using emulated::make_mode;
using testing::ElementsAre;
using testing::HasSubstr;

Monitor monitor(const std::string& plug, Connection connection = Connection::Connected,
                const std::string& id = "") {
    Monitor m;
    m.card = "card0";
    m.plug = plug;
    m.connection = connection;
    m.id = id;
    if (connection == Connection::Connected) m.modes = {make_mode(1280, 1024, 60.0, true)};
    return m;
}

std::vector<std::string> names(const std::vector<ChosenMode>& modes) {
    std::vector<std::string> result;
    for (const ChosenMode& m : modes) result.push_back(describe(m.mode));
    return result;
}

std::string chosen_plug(const std::vector<Monitor>& monitors, const Wish& wish) {
    const auto chosen = choose_monitor(monitors, wish);
    return chosen ? monitors[chosen->index].plug : "none";
}

TEST(MonitorChoice, TakesTheFirstThatIsConnectedAndHasModes) {
    Monitor mute = monitor("DP-1");
    mute.modes.clear();
    EXPECT_EQ(
        chosen_plug({monitor("VGA-1", Connection::Disconnected), mute, monitor("DP-2"), monitor("DP-3")}, {}),
        "DP-2");
    EXPECT_EQ(chosen_plug({monitor("VGA-1", Connection::Disconnected)}, {}), "none");
}

TEST(MonitorChoice, PrefersTheScreenOfLastTimeOnWhateverPlugItIs) {
    const std::vector<Monitor> two{monitor("DP-1", Connection::Connected, "aa"),
                                   monitor("DP-2", Connection::Connected, "bb")};
    EXPECT_EQ(chosen_plug(two, {.last_used = "bb"}), "DP-2");
    EXPECT_EQ(chosen_plug(two, {.last_used = "cc"}), "DP-1") << "that one is gone";
}

TEST(MonitorChoice, APlugThatIsNamedIsTakenAndNoOther) {
    std::vector<Monitor> two{monitor("DP-1", Connection::Connected, "aa"), monitor("DP-2")};
    EXPECT_EQ(chosen_plug(two, {.connector = "DP-2", .last_used = "aa"}), "DP-2");
    EXPECT_EQ(chosen_plug(two, {.connector = "DP-9"}), "none");
    two.push_back(monitor("DP-2"));
    two[2].card = "card1";
    EXPECT_EQ(choose_monitor(two, {.connector = "card1-DP-2"})->index, 2U);
}

TEST(MonitorChoice, APlugOfUnknownStateCountsOnlyWhenItIsNamed) {
    const std::vector<Monitor> unknown{monitor("VGA-1", Connection::Unknown)};
    EXPECT_EQ(chosen_plug(unknown, {}), "none");
    EXPECT_EQ(chosen_plug(unknown, {.connector = "VGA-1"}), "VGA-1");
    EXPECT_EQ(chosen_plug({monitor("VGA-1", Connection::Disconnected)}, {.connector = "VGA-1"}), "none");
}

TEST(ModeChoice, GoesDownFromTheWishedOneToTheSmallest) {
    Monitor m = monitor("DP-1");
    m.modes = {make_mode(2560, 1440, 60.0, true), make_mode(1920, 1080, 60.0), make_mode(1920, 1080, 50.0),
               make_mode(1280, 720, 60.0),        make_mode(1280, 720, 50.0),  make_mode(640, 480, 60.0)};
    EXPECT_THAT(names(choose_modes(m, {.mode = "1280x720@50"})),
                ElementsAre("1280x720@50", "2560x1440@60", "1920x1080@60", "1280x720@60", "640x480@60"));
    EXPECT_THAT(choose_modes(m, {.mode = "1280x720@50"}).front().why, HasSubstr("asks for it"));
}

TEST(ModeChoice, TheNearestRateOfTheWishedSizeBeatsThePreferredMode) {
    Monitor m = monitor("DP-1");
    m.modes = {make_mode(2560, 1440, 60.0, true), make_mode(1920, 1080, 50.0), make_mode(1920, 1080, 75.0)};
    EXPECT_EQ(names(choose_modes(m, {.mode = "1920x1080@72"})).front(), "1920x1080@75");
    EXPECT_EQ(names(choose_modes(m, {.mode = "1920x1080"})).front(), "1920x1080@50") << "nearest to 60";
    EXPECT_EQ(names(choose_modes(m, {.mode = "800x600"})).front(), "2560x1440@60");
    EXPECT_THAT(choose_modes(m, {.mode = "800x600"}).front().why, HasSubstr("none of the size"));
}

TEST(ModeChoice, WholePicturesBeatInterlacedOnes) {
    Monitor m = monitor("DP-1");
    m.modes = {make_mode(1920, 1080, 60.0), make_mode(1920, 1080, 50.0)};
    m.modes[0].flags |= DRM_MODE_FLAG_INTERLACE;
    m.modes[0].clock /= 2;
    ASSERT_NEAR(refresh_hz(m.modes[0]), 60.0, 0.1);
    EXPECT_EQ(names(choose_modes(m, {.mode = "1920x1080@60"})).front(), "1920x1080@50");
}

TEST(ModeChoice, AMonitorThatPrefersNothingGetsFullHd) {
    Monitor m = monitor("DP-1");
    m.modes = {make_mode(640, 480, 60.0), make_mode(1920, 1080, 60.0), make_mode(1280, 720, 60.0)};
    EXPECT_EQ(names(choose_modes(m, {})).front(), "1920x1080@60");
    m.modes = {make_mode(800, 600, 60.0)};
    EXPECT_THAT(names(choose_modes(m, {})), ElementsAre("800x600@60")) << "better than nothing";
}

TEST(ModeChoice, APlugThatNamesNoModesGetsTheUsualOnes) {
    Monitor m = monitor("VGA-1", Connection::Unknown);
    EXPECT_THAT(names(choose_modes(m, {})), ElementsAre("1920x1080@60", "1280x720@60", "640x480@59.94"));
    EXPECT_EQ(names(choose_modes(m, {.mode = "1280x720@60"})).front(), "1280x720@60");
}

TEST(ModeChoice, AModeIsWrittenAsWidthTimesHeightAndItsRate) {
    EXPECT_EQ(parse_mode("1920x1080")->height, 1080);
    EXPECT_EQ(parse_mode("1920x1080@59.94")->hz, 59.94);
    for (const char* wrong : {"", "1920", "1920x", "x1080", "1920x1080@", "1920x1080@x", "1920x1080 ", "-1x1",
                              "1920x1080@60Hz", "0x0", "1920x1080@inf", "1920x1080@nan"})
        EXPECT_FALSE(parse_mode(wrong)) << wrong;
}

}  // namespace
}  // namespace eddy::kms
