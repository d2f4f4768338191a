#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/end_to_end/program.h"
#include "tests/hal/haptic/synthetic_firmware.h"

// The program as it is shipped, with a Falcon below its libusb (tests/usb/preload.cpp). Real time: nothing here depends
// on how fast the machine is.

namespace eddy {
namespace {

using ::testing::HasSubstr;

class RealFalcon : public testing::Test {
  protected:
    void SetUp() override {
        if (EDDY_SANITIZED) GTEST_SKIP() << "skipped: a sanitizer wants to be loaded before anything else";
    }
    /// Runs eddy with a Falcon that starts like that.
    static Ended eddy_with(const std::string& start, std::vector<std::string> arguments,
                           const std::string& unplug = {}) {
        std::vector<std::string> command{"env", std::string("LD_PRELOAD=") + EDDY_USB_PRELOAD,
                                         "EDDY_TEST_FALCON=" + start, "EDDY_TEST_UNPLUG=" + unplug,
                                         EDDY_BINARY};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return Program(std::move(command)).wait();
    }
    std::string firmware() const {
        const auto image = synthetic_firmware(500);
        std::ofstream file(folder_ / "falcon.bin", std::ios::binary);
        for (const std::uint8_t byte : image) file.put(static_cast<char>(byte));
        return folder_ / "falcon.bin";
    }
    std::vector<std::string> short_run(std::vector<std::string> more) const {
        std::vector<std::string> all{"run",       "--scene",       "stir",        "--set",          kTiny,
                                     "--run-dir", folder_ / "run", "--state-dir", folder_ / "state"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    nlohmann::json status() const {
        std::ifstream file(folder_ / "run/status.json");
        return nlohmann::json::parse(file);
    }

    const ScratchFolder folder_;
};

TEST_F(RealFalcon, IsFoundStartedFromColdAndDescribed) {
    const Ended ended = eddy_with("cold", {"falcon", "--firmware", firmware(), "--seconds", "3"});
    EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("state        ready"));
    EXPECT_THAT(ended.out, HasSubstr("Novint Falcon EMUL0001: ready"));
    EXPECT_THAT(ended.err, HasSubstr("loading"));
    EXPECT_THAT(ended.err, HasSubstr("homing"));
    std::smatch rate;
    ASSERT_TRUE(std::regex_search(ended.out, rate, std::regex("rate +([0-9]+) exchanges/s"))) << ended.out;
    RecordProperty("exchanges_per_s_in_real_time", rate[1].str());
    EXPECT_GT(std::stoi(rate[1]), 50);
}

TEST_F(RealFalcon, IsMissedWithAWordAndExitStatusOne) {
    const Ended ended = eddy_with("warm", {"falcon", "--serial", "NOTTHIS1", "--seconds", "1"});
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.out, HasSubstr("not the one with the serial asked for"));
    const ScratchFolder etc;
    etc.write("exhibit.toml", "[falcon]\nserial = \"NOTTHIS1\"\n");
    const Ended by_file = eddy_with("warm", {"falcon", "--config", etc.path(), "--seconds", "1"});
    EXPECT_EQ(by_file.status, 1);
    EXPECT_THAT(by_file.out, HasSubstr("not the one with the serial asked for"));
}

TEST_F(RealFalcon, MovesTheBodyOfTheExhibitWhenItIsPluggedIn) {
    const Ended ended = eddy_with("warm", short_run({"--seconds", "2"}));
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("Novint Falcon EMUL0001"));
    const auto haptics = status()["haptics"];
    EXPECT_EQ(haptics["state"], "ready");
    EXPECT_GT(haptics["exchanges"].get<long>(), 100);
    EXPECT_EQ(haptics["usb_errors"], 0);
}

TEST_F(RealFalcon, MayBeUnpluggedWhileTheShowRuns) {
    const Ended ended = eddy_with("warm", short_run({"--haptics", "falcon", "--seconds", "3"}), "1.0-1.3");
    ASSERT_EQ(ended.status, 0) << ended.err;
    const auto haptics = status()["haptics"];
    EXPECT_EQ(haptics["state"], "ready");
    EXPECT_EQ(haptics["lost"], 1);
}

TEST_F(RealFalcon, LeavesAFlightOfItsUnpluggingThatRunsAgainBitForBit) {
    const Ended ended = eddy_with("warm", short_run({"--haptics", "falcon", "--seconds", "5"}), "3.0-3.3");
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_GE(status()["haptics"]["flights"].get<int>(), 1);
    std::string flight;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "state/flights"))
        if (entry.path().filename().string().find("-device_") != std::string::npos)
            flight = entry.path().string();
    ASSERT_NE(flight, "") << ended.err;
    EXPECT_THAT(ended.err, HasSubstr(flight + "; eddy replay runs them again"));
    std::vector<std::string> command{"replay", flight};
    const std::string picture = folder_ / "flight.png";
    if (has_gnuplot()) command.insert(command.end(), {"--plot", picture});
    const Ended replayed = eddy(command);
    EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("rerun       the same, bit for bit"));
    EXPECT_THAT(replayed.out, HasSubstr("cause       device_"));
    if (has_gnuplot()) {
        EXPECT_EQ(read_all(picture).substr(1, 3), "PNG");
    }
}

}  // namespace
}  // namespace eddy
