#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;

const std::filesystem::path kUnits = std::filesystem::path(EDDY_SOURCE_DIR) / "systemd";

bool has_systemd_analyze() {
    return std::system("command -v systemd-analyze >/dev/null") == 0;
}

/// The units as they are installed, but for the place of the program, in a folder of their own.
class Units : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_systemd_analyze()) GTEST_SKIP() << "skipped: systemd-analyze is not here (package systemd)";
        for (const auto& entry : std::filesystem::directory_iterator(kUnits)) {
            const std::string name = entry.path().filename().string();
            if (!name.ends_with(".service") && !name.ends_with(".path")) continue;
            std::string text = read_all(entry.path());
            text = std::regex_replace(text, std::regex("/usr/bin/eddy"), EDDY_BINARY);
            paths_.push_back(folder_.write(name, text));
        }
    }
    Ended verify(const std::vector<std::string>& units) {
        std::vector<std::string> command{"systemd-analyze", "verify"};
        command.insert(command.end(), units.begin(), units.end());
        return Program(command).wait();
    }
    ScratchFolder folder_;
    std::vector<std::string> paths_;
};

TEST_F(Units, SayNothingThatSystemdDoesNotUnderstand) {
    const Ended found = verify(paths_);
    EXPECT_EQ(found.status, 0);
    EXPECT_EQ(found.err + found.out, "");
    ASSERT_EQ(paths_.size(), 3U);
}

TEST(UnitsOfTheImage, AreAllThatWantToBeStarted) {
    const std::string list = read_all(std::filesystem::path(EDDY_SOURCE_DIR) / "image" / "units");
    const std::size_t begin = list.find("[enabled]");
    ASSERT_NE(begin, std::string::npos);
    const std::string enabled = list.substr(begin, list.find('[', begin + 1) - begin);
    int wanted = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kUnits)) {
        if (!entry.is_regular_file() || read_all(entry.path()).find("\nWantedBy=") == std::string::npos)
            continue;
        EXPECT_THAT(enabled, HasSubstr(entry.path().filename().string()));
        ++wanted;
    }
    EXPECT_EQ(wanted, 2);
}

TEST_F(Units, AMistakeWouldBeSeen) {
    const std::string bad = folder_.write("bad.service", "[Service]\nExecStart=/bin/true\nRestrat=always\n");
    EXPECT_THAT(verify({bad}).err, HasSubstr("Restrat"));
}

TEST_F(Units, TheExhibitIsExposedByOneAndAHalfAtMost) {
    const Ended found =
        Program({"systemd-analyze", "security", "--offline=true", folder_ / "eddy.service"}).wait();
    std::smatch m;
    const std::regex kLevel(R"(Overall exposure level for eddy.service: ([0-9.]+))");
    ASSERT_TRUE(std::regex_search(found.out, m, kLevel)) << found.out << found.err;
    EXPECT_LE(std::stod(m[1]), 1.5) << found.out;
}

/// Values of a key of eddy.service.
std::vector<std::string> values_of(const std::string& key) {
    std::vector<std::string> values;
    for (const std::string& line : lines_of(read_all(kUnits / "eddy.service")))
        if (line.starts_with(key + "=")) values.push_back(line.substr(key.size() + 1));
    return values;
}

TEST(EddyService, BearsWithEightSecondsOfSilenceAndIsStartedAgainAtOnce) {
    using testing::ElementsAre;
    EXPECT_THAT(values_of("Type"), ElementsAre("notify"));
    EXPECT_THAT(values_of("WatchdogSec"), ElementsAre("8"));
    EXPECT_THAT(values_of("Restart"), ElementsAre("always"));
    EXPECT_THAT(values_of("RestartSec"), ElementsAre("200ms"));
    EXPECT_THAT(values_of("StartLimitAction"), ElementsAre("reboot"));
}

/// Of a kind that the kernel has not heard of when the service starts, systemd allows none for as long as it runs.
TEST(EddyService, WaitsForEachKindOfDeviceThatComesWithAModule) {
    const std::string unit = read_all(kUnits / "eddy.service");
    const std::map<std::string, std::string> modules{
        {"drm", "drm"}, {"usb_device", "usbcore"}, {"gpiochip", ""}};
    const std::regex kind("\nDeviceAllow=char-(\\w+)");
    int kinds = 0;
    for (std::sregex_iterator found(unit.begin(), unit.end(), kind), end; found != end; ++found, ++kinds) {
        const std::string name = (*found)[1];
        ASSERT_TRUE(modules.contains(name)) << name << ": built into the kernel, or of which module?";
        const std::string& module = modules.at(name);
        if (module.empty()) continue;
        for (const char* key : {"Wants", "After"})
            EXPECT_TRUE(
                std::regex_search(unit, std::regex(fmt::format("\n{}=.*modprobe@{}\\.service", key, module))))
                << key << ' ' << module;
    }
    EXPECT_EQ(kinds, 3);
}

TEST(EddyService, LetsTheRasteriserWriteCodeAndGivesNoThreadPriorityUnasked) {
    using testing::IsEmpty;
    EXPECT_THAT(values_of("MemoryDenyWriteExecute"), IsEmpty());
    EXPECT_THAT(values_of("CPUSchedulingPolicy"), IsEmpty());
    EXPECT_THAT(values_of("RestrictRealtime"), IsEmpty());
}

}  // namespace
}  // namespace eddy
