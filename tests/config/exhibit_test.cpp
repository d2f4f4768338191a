#include "config/exhibit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "config/scene.h"
#include "tests/config/complaints.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// A configuration folder like /etc/eddy.
class ExhibitFolder : public testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_ / "conf.d"); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }

    const std::filesystem::path folder_ =
        testing::TempDir() + "eddy_" + testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST(Exhibit, FactoryFileSaysWhatTheStructSays) {
    EXPECT_EQ(load_exhibit("/nonexistent").exhibit, Exhibit{});
}

TEST(Exhibit, FactoryFileSetsEveryKey) {
    const LoadedExhibit loaded = load_exhibit("/nonexistent");
    EXPECT_THAT(print_exhibit(loaded.exhibit, &loaded.origins), Not(HasSubstr("# default")));
}

TEST_F(ExhibitFolder, LaterFilesWinKeyByKeyAndOriginsAreKept) {
    const std::string main = write("exhibit.toml", "scene = \"stir\"\nmax_force_n = 3\n");
    const std::string second = write("conf.d/20-hall.toml", "max_force_n = 1\n");
    write("conf.d/10-site.toml", "max_force_n = 2\nhaptics = \"none\"\n");
    write("conf.d/30-off.toml.bak", "max_force_n = 7\n");
    const LoadedExhibit loaded = load_exhibit(folder_);
    EXPECT_EQ(loaded.exhibit.scene, "stir");
    EXPECT_EQ(loaded.exhibit.max_force_n, 1.0);
    EXPECT_EQ(loaded.exhibit.haptics, HapticsChoice::None);
    const std::string text = print_exhibit(loaded.exhibit, &loaded.origins);
    EXPECT_THAT(text, HasSubstr("scene = \"stir\"  # " + main + ":1:9\n"));
    EXPECT_THAT(text, HasSubstr("max_force_n = 1  # " + second + ":1:15\n"));
    EXPECT_THAT(text, HasSubstr("display = \"auto\"  # config/exhibit.toml:"));
}

TEST_F(ExhibitFolder, ADropInCanLowerTheCeilingOfTheForceAndNotRaiseIt) {
    write("exhibit.toml", "max_force_n = 3\n");
    const std::string drop_in = write("conf.d/10-site.toml", "max_force_n = 2\n");
    EXPECT_EQ(load_exhibit(folder_).exhibit.max_force_n, 2.0);
    write("conf.d/10-site.toml", "max_force_n = 3.5\n");
    EXPECT_THAT(complaints([&] { load_exhibit(folder_); }),
                ElementsAre(AllOf(StartsWith(drop_in + ":1:15:"), HasSubstr("without them it is 3;"),
                                  HasSubstr("exhibit.toml"))));
    write("exhibit.toml", "# nothing\n");
    EXPECT_THAT(complaints([&] { load_exhibit(folder_); }), testing::SizeIs(0)) << "the factory's is 4";
    write("conf.d/10-site.toml", "max_force_n = 4.5\n");
    EXPECT_THAT(complaints([&] { load_exhibit(folder_); }), testing::SizeIs(1));
}

TEST_F(ExhibitFolder, HoursThatNoClockShowsAreRefusedWhereTheyStand) {
    const std::string main =
        write("exhibit.toml", "[hours]\nmonday = \"9-17\"\nexceptions = \"Christmas\"\n");
    EXPECT_THAT(complaints([&] { load_exhibit(folder_); }),
                ElementsAre(StartsWith(main + ":2:10: hours.monday: '9' is no time"),
                            StartsWith(main + ":3:14: hours.exceptions: 'Christmas' is no day")));
}

TEST_F(ExhibitFolder, MistakesNameTheFileTheyAreIn) {
    const std::string main = write("exhibit.toml", "scen = \"stir\"\n");
    const std::string drop_in = write("conf.d/10-site.toml", "\nhaptics = \"falcn\"\nmax_force_n = 9\n");
    EXPECT_THAT(
        complaints([&] { load_exhibit(folder_); }),
        ElementsAre(
            drop_in + ":2:11: haptics: \"falcn\" is no word for this key; valid, nearest first: \"falcon\", "
                      "\"auto\", \"none\", \"emulated\"",
            drop_in + ":3:15: max_force_n: 9 is out of range: must be at least 0 and at most 8",
            main + ":1:1: scen: unknown key; nearest valid key: scene"));
}

TEST_F(ExhibitFolder, MistakesOfAllFilesAreToldAtOnceAlsoWhereALaterFileWins) {
    const std::string main = write("exhibit.toml", "max_force_n = 99\ndisplay = 3\n");
    const std::string second = write("conf.d/10-site.toml", "= 1\n");
    const std::string third = write("conf.d/20-hall.toml", "max_force_n = 1\nscene = \"sitr\"\n");
    const std::string cut = write("conf.d/30-cut.toml", "max_force");
    write("conf.d/.10-site.toml", "hidden");
    EXPECT_THAT(complaints([&] { load_exhibit(folder_); }),
                ElementsAre(StartsWith(second + ":1:1: "), StartsWith(third + ":2:9: scene: "),
                            StartsWith(cut + ":1:10: seems to be cut off"), StartsWith(cut + ":1:10: "),
                            StartsWith(main + ":1:15: max_force_n: 99 is out of range"),
                            StartsWith(main + ":2:11: display: ")));
}

TEST_F(ExhibitFolder, DropInsAreNoLinks) {
    write("there.toml", "max_force_n = 1\n");
    std::filesystem::create_symlink("../there.toml", folder_ / "conf.d/10.toml");
    EXPECT_THAT(complaints([&] { load_exhibit(folder_); }), ElementsAre(HasSubstr("is a symbolic link")));
    std::filesystem::remove(folder_ / "conf.d/10.toml");
    std::filesystem::create_symlink("there.toml", folder_ / "exhibit.toml");
    EXPECT_EQ(load_exhibit(folder_).exhibit.max_force_n, 1.0);
}

TEST_F(ExhibitFolder, ASceneFileIsNamedFromTheFolder) {
    const std::string file = write("exhibit.toml", "scene = \"scenes/hall.toml\"\n");
    const std::string absolute = (folder_ / "scenes/hall.toml").lexically_normal();
    EXPECT_EQ(load_exhibit(folder_).exhibit.scene, absolute);
    EXPECT_EQ(load_exhibit_file(file).exhibit.scene, absolute);
    const std::string drop_in = write("conf.d/10.toml", "scene = \"scenes/hall.toml\"\n");
    EXPECT_EQ(load_exhibit_file(drop_in).exhibit.scene, absolute);
}

TEST_F(ExhibitFolder, AFileOfTheFalconAloneIsNoScene) {
    EXPECT_FALSE(
        holds_a_scene(write("exhibit.toml", "haptics = \"none\"\npresets = []\n[falcon]\nserial = \"F\"\n")));
    EXPECT_TRUE(holds_a_scene(write("scene.toml", "[haptics]\ngain = 1\n")));
}

TEST_F(ExhibitFolder, UnknownSceneNamesTheNearest) {
    const std::string file = write("exhibit.toml", "scene = \"sitr\"\n");
    EXPECT_THAT(complaints([&] { load_exhibit_file(file); }),
                ElementsAre(StartsWith(
                    file + ":1:9: scene: \"sitr\" is neither a shipped scene nor a path; shipped, nearest "
                           "first: \"stir\"")));
}

TEST_F(ExhibitFolder, TheForceIsModelledUnlessTheFilterIsAskedFor) {
    EXPECT_EQ(load_exhibit(folder_).exhibit.force, ForceChoice::Model);
    write("exhibit.toml", "force = \"filter\"\n");
    EXPECT_EQ(load_exhibit(folder_).exhibit.force, ForceChoice::Filter);
}

TEST_F(ExhibitFolder, FoldersMustBeAbsolute) {
    const std::string file = write("exhibit.toml", "state_dir = \"state\"\n");
    EXPECT_THAT(complaints([&] { load_exhibit_file(file); }),
                ElementsAre(file + ":1:13: state_dir: \"state\" must start with a slash"));
}

TEST_F(ExhibitFolder, LinesOfThePanelAreNamedInATableOfTheirOwn) {
    const std::string file = write("exhibit.toml",
                                   "[gpio]\nbutton = \"GPIO17\"\nstop = \"cp2112_gpio:1\"\n"
                                   "lamp_red = \"GPIO22\"\nlamps_active_low = true\n");
    const GpioConfig gpio = load_exhibit_file(file).exhibit.gpio;
    EXPECT_EQ(gpio.button, "GPIO17");
    EXPECT_EQ(gpio.stop, "cp2112_gpio:1");
    EXPECT_EQ(gpio.lamp_red, "GPIO22");
    EXPECT_EQ(gpio.lamp_green, "");
    EXPECT_TRUE(gpio.lamps_active_low);
    EXPECT_TRUE(gpio.button_active_low);
    EXPECT_FALSE(gpio.stop_active_low);
}

TEST_F(ExhibitFolder, ALineOfThePanelHasOneUse) {
    const std::string file = write("exhibit.toml", "[gpio]\nbutton = \"GPIO17\"\nlamp_red = \"GPIO17\"\n");
    EXPECT_THAT(complaints([&] { load_exhibit_file(file); }),
                ElementsAre(file + ":3:12: gpio.lamp_red: line \"GPIO17\" is that of gpio.button already"));
}

TEST_F(ExhibitFolder, AStopInputNeedsAButtonToComeBackBy) {
    const std::string file = write("exhibit.toml", "[gpio]\nstop = \"GPIO17\"\n");
    EXPECT_THAT(
        complaints([&] { load_exhibit_file(file); }),
        ElementsAre(AllOf(StartsWith(file + ":2:8: gpio.stop:"), HasSubstr("gpio.button must name one"))));
}

TEST_F(ExhibitFolder, ADropInCannotChangeTheStopInput) {
    write("exhibit.toml", "[gpio]\nbutton = \"GPIO17\"\nstop = \"GPIO27\"\n");
    for (const std::string line : {"stop = \"GPIO5\"", "stop = \"\"", "stop_active_low = true",
                                   "stop = \"GPIO27\"", "lamp_red = \"GPIO5\""}) {
        const std::string drop_in = write("conf.d/10-site.toml", "[gpio]\n" + line + "\n");
        const auto found = complaints([&] { load_exhibit(folder_); });
        const bool may = line == "stop = \"GPIO27\"" || line.starts_with("lamp");
        ASSERT_EQ(found.size(), may ? 0U : 1U) << line;
        if (!may) {
            EXPECT_THAT(found.front(),
                        AllOf(StartsWith(drop_in + ":2:"), HasSubstr("no file in conf.d can change")));
        }
    }
}

TEST_F(ExhibitFolder, FalconIsSetInATableOfItsOwn) {
    const std::string file =
        write("exhibit.toml", "[falcon]\nfirmware = \"/etc/eddy/falcon.bin\"\nserial = \"FTPNM0FB\"\n");
    const FalconConfig falcon = load_exhibit_file(file).exhibit.falcon;
    EXPECT_EQ(falcon.firmware, "/etc/eddy/falcon.bin");
    EXPECT_EQ(falcon.serial, "FTPNM0FB");
    EXPECT_EQ(falcon.motor_units_per_nm, 10000.0);
    write("exhibit.toml", "[falcon]\nfirmware = \"falcon.bin\"\nmotor_units_per_nm = 10\n");
    EXPECT_THAT(complaints([&] { load_exhibit_file(file); }),
                ElementsAre(HasSubstr("falcon.firmware: \"falcon.bin\" must start with a slash"),
                            HasSubstr("falcon.motor_units_per_nm: 10 is out of range")));
}

TEST_F(ExhibitFolder, PresetsAreNamedOnceEach) {
    const std::string file = write("exhibit.toml", "presets = [\"fast\", \"precise\", \"fast\"]\n");
    EXPECT_THAT(complaints([&] { load_exhibit_file(file); }),
                ElementsAre(HasSubstr(":1:11: presets: \"fast\" is there twice")));
}

TEST_F(ExhibitFolder, PresetsThatChangeByThemselvesMustBeNamed) {
    for (const std::string presets : {"", "presets = [\"fast\"]\n"}) {
        const std::string file = write("exhibit.toml", "preset_s = 30\n" + presets);
        EXPECT_THAT(
            complaints([&] { load_exhibit_file(file); }),
            ElementsAre(
                file +
                ":1:12: preset_s: there are no presets that could change; presets must name two or more"));
    }
    write("exhibit.toml", "preset_s = 30\n");
    write("conf.d/10-site.toml", "presets = [\"fast\", \"yang2009\"]\n");
    EXPECT_EQ(load_exhibit(folder_).exhibit.preset_s, 30.0);
}

TEST_F(ExhibitFolder, FileThatIsCheckedMustExist) {
    EXPECT_THAT(complaints([&] { load_exhibit_file(folder_ / "absent.toml"); }),
                ElementsAre(HasSubstr("absent.toml: cannot be read: No such file")));
}

TEST_F(ExhibitFolder, AScreensModeIsWrittenAsWidthTimesHeightAndItsRate) {
    write("exhibit.toml", "[screen]\nconnector = \"HDMI-A-1\"\nmode = \"1920x1080@59.94\"\nmax_pixels = 0\n");
    EXPECT_EQ(load_exhibit(folder_).exhibit.screen, (ScreenConfig{"HDMI-A-1", "1920x1080@59.94", 0}));
    for (const std::string wrong :
         {"full", "1920", "1920x", "1920x1080@", "1920x1080p", "0x480", "1920x1080@60Hz"}) {
        const std::string file = write("exhibit.toml", "[screen]\nmode = \"" + wrong + "\"\n");
        EXPECT_THAT(complaints([&] { load_exhibit(folder_); }),
                    ElementsAre(AllOf(StartsWith(file + ":2:8: screen.mode:"), HasSubstr("1920x1080@60"))));
    }
}

}  // namespace
}  // namespace eddy
