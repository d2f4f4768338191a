#include <gtest/gtest.h>
#include <stdio.h>

#include "firmware/exhibit/config_report.h"
#include "firmware/status.h"
#include "hal/display/display.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

/// The machine's scripts read by line what the program writes of itself.
class ImageHealth : public testing::Test {
  protected:
    ImageHealth() { std::filesystem::create_directory(told_.path() / "status"); }

    void tell(const Status& status, const ConfigReport& settings) {
        ASSERT_TRUE(write_status(told_ / "status.json", status));
        write_config_report({told_.path() / "status"}, settings);
    }
    std::string say(const std::string& what) {
        const std::string command = "cd " + told_.path().string() + "; told=" + told_.path().string() +
                                    "; . " EDDY_SOURCE_DIR "/image/root/usr/lib/eddy-image/health; " + what;
        FILE* shell = ::popen(command.c_str(), "r");
        if (!shell) return "no shell";
        std::string said;
        for (int c; (c = ::fgetc(shell)) != EOF;) said += static_cast<char>(c);
        ::pclose(shell);
        return said;
    }

    const ScratchFolder told_;
};

TEST_F(ImageHealth, ShowsWhereThereIsAShowOrAClosedHouse) {
    EXPECT_EQ(say("shows || echo no"), "no\n") << "nothing is said yet";
    for (const Word<ExhibitState>& row : kExhibitStates) {
        Status status;
        status.vital_signs.state = row.value;
        tell(status, {});
        const bool none = row.value == ExhibitState::Starting || row.value == ExhibitState::Safe;
        EXPECT_EQ(say("shows || echo no"), none ? "no\n" : "") << row.word;
    }
}

TEST_F(ImageHealth, LacksAScreenThatCannotBeUsedAndSettingsThatAreNotTaken) {
    EXPECT_EQ(say("lacks"), "");
    Status status;
    status.display = "HDMI-A-1 of /dev/dri/card0 (television), 1920x1080@60";
    ConfigReport settings;
    tell(status, settings);
    EXPECT_EQ(say("lacks"), "");
    status.display = make_headless_display()->describe();
    tell(status, settings);
    EXPECT_EQ(say("lacks"), "screen\n");
    settings.stands_in = true;
    tell(status, settings);
    EXPECT_EQ(say("lacks"), "screen\nsettings\n");
}

// As they lie in the firmware's partition: a version that ends like another is another.
TEST_F(ImageHealth, FindsTheProgramsOfAVersionAndOfNoOther) {
    const auto found = [&](const std::string& version, const std::string& more = "") {
        return say(
            "printf '%s\\n' eddy-0001-2.efi eddy-0002-hall-2.efi eddy-0003-2+1-2.efi "
            "eddy-0004-update-2+0-3.efi "
            "eddy-0005-1x0.efi eddy-0006-1.0+3.efi eddy-0007-2.efi.part >all; "
            ". " EDDY_SOURCE_DIR "/image/root/usr/lib/eddy-image/disk; programs_of " +
            version + " " + more + " <all");
    };
    EXPECT_EQ(found("2"), "eddy-0001-2.efi\neddy-0003-2+1-2.efi\n");
    EXPECT_EQ(found("hall-2"), "eddy-0002-hall-2.efi\n");
    EXPECT_EQ(found("1.0"), "eddy-0006-1.0+3.efi\n");
    EXPECT_EQ(found("2", "+0-[0-9]*"), "");
    EXPECT_EQ(found("update-2", "+0-[0-9]*"), "eddy-0004-update-2+0-3.efi\n");
    EXPECT_EQ(found("2", "'+[0-9-]*'"), "eddy-0003-2+1-2.efi\n");
}

}  // namespace
}  // namespace eddy
