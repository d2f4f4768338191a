#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

std::vector<std::string> small_run(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",
                                       "--display",
                                       "headless",
                                       "--haptics",
                                       "emulated",
                                       "--set",
                                       "tank.cells=[16,16,16]",
                                       "--set",
                                       "render.width_px=160",
                                       "--set",
                                       "render.height_px=120"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// One second of virtual time, recorded into the folder.
void record(const std::string& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments =
        small_run({"--clock", "stepped", "--seconds", "1", "--record", folder});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = eddy(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(lines_of(ended.out).size(), 10u) << ended.out;
}

/// Columns 0 to 3 (time, x, y, z) of a motion or of force.csv; comments and the header left out.
std::vector<std::array<double, 4>> read_path(const std::string& file) {
    std::vector<std::array<double, 4>> path;
    for (const std::string& line : lines_of(read_all(file))) {
        if (line.empty() || line[0] == '#' || line[0] == 't') continue;
        const std::vector<std::string> cells = split(line, ',');
        path.push_back(
            {std::stod(cells.at(0)), std::stod(cells.at(1)), std::stod(cells.at(2)), std::stod(cells.at(3))});
    }
    return path;
}

TEST(SteppedRun, IsTheSameBitForBitEachTime) {
    const ScratchFolder folder;
    record(folder / "a");
    record(folder / "b");
    int pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a")) {
        if (entry.path().extension() == ".gnuplot") continue;  // names its folder
        const std::string name = entry.path().filename().string();
        EXPECT_EQ(read_all(entry.path()), read_all(folder / ("b/" + name))) << name;
        pictures += name.rfind("frame_", 0) == 0;
    }
    EXPECT_EQ(pictures, 11);  // of the first step, and then every 0.1 s up to 1 s
    EXPECT_EQ(read_path(folder / "a/force.csv").size(), 1000u);
}

TEST(SteppedRun, WithAPageOverItsPicturesMovesAsItDoesWithout) {
    const ScratchFolder folder;
    record(folder / "plain");
    record(folder / "page", {"--overlay", "cost"});
    record(folder / "none", {"--overlay", "none"});
    EXPECT_EQ(read_all(folder / "page/force.csv"), read_all(folder / "plain/force.csv"));
    EXPECT_NE(read_all(folder / "page/frame_0007.png"), read_all(folder / "plain/frame_0007.png"));
    EXPECT_EQ(read_all(folder / "none/frame_0007.png"), read_all(folder / "plain/frame_0007.png"));
}

TEST(SteppedRun, WithAnotherSeedIsAnother) {
    const ScratchFolder folder;
    record(folder / "a", {"--fps", "1"});
    record(folder / "b", {"--fps", "1", "--seed", "2"});
    EXPECT_NE(read_all(folder / "a/force.csv"), read_all(folder / "b/force.csv"));
}

TEST(SteppedRun, TakesTheHandAlongEachRecordedMotion) {
    const char* recordings = std::getenv("EDDY_MOTIONS");
    if (!recordings) GTEST_SKIP() << "skipped: EDDY_MOTIONS names no folder of recordings";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(recordings)) {
        if (entry.path().extension() != ".csv") continue;
        ++files;
        const ScratchFolder folder;
        record(folder / "run", {"--fps", "1", "--motion", entry.path().string(), "--motion-axes", "x,z,-y"});
        const auto ticks = read_path(folder / "run/force.csv");
        const auto wanted = read_path(entry.path().string());
        ASSERT_EQ(ticks.size(), 1000u) << entry.path();
        int compared = 0;
        for (const auto& sample : wanted) {
            // The emulated Falcon needs its time to start and home; a reading is a tick old when it arrives.
            const double t = sample[0] - wanted[0][0] + 0.001;
            if (t < 0.5 || t > 0.99) continue;
            const auto& tick = ticks[static_cast<std::size_t>(std::lround(t * 1e3))];
            const double off = std::hypot(tick[1] - sample[1], tick[2] - sample[3], tick[3] + sample[2]);
            EXPECT_LT(off, 1e-3) << entry.path() << " at " << t << " s";
            ++compared;
        }
        EXPECT_GT(compared, 20) << entry.path();
    }
    EXPECT_GT(files, 0) << recordings;
}

TEST(SteppedRun, WithoutAHandHasAPictureButNoForce) {
    const ScratchFolder folder;
    const Ended ended = eddy({"run", "--haptics", "none", "--clock", "stepped", "--seconds", "0.2", "--set",
                              "tank.cells=[16,16,16]", "--set", "render.width_px=160", "--set",
                              "render.height_px=120", "--record", folder / "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "run/frame_0000.png"));
    EXPECT_EQ(lines_of(read_all(folder / "run/force.csv")).size(), 1u);
}

TEST(Run, EndsByItselfAndSaysHowItWent) {
    const ScratchFolder folder;
    const Ended ended = eddy(small_run({"--seconds", "1", "--run-dir", folder / "run"}));
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::vector<std::string> lines = lines_of(ended.out);
    ASSERT_EQ(lines.size(), 10u) << ended.out;
    const std::array<std::string, 10> heads{"scene",      "renderer", "hand",        "fluid", "ms a stage",
                                            "divergence", "force",    "haptic loop", "gate",  "recorded"};
    for (std::size_t i = 0; i < heads.size(); ++i) EXPECT_EQ(lines[i].rfind(heads[i], 0), 0u) << lines[i];

    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"run/", "run/eddy.prom", "run/status.json",
                                                          "run/status/", "run/status/config.json"}));
    const nlohmann::json status = nlohmann::json::parse(read_all(folder / "run/status.json"));
    const double uptime = status.at("uptime_s");
    EXPECT_GE(uptime, 1.0);
    EXPECT_GT(status.at("fluid").at("steps").get<int>(), 0);
    const nlohmann::json& cost = status.at("cost");
    EXPECT_EQ(cost.at("preset"), "fast");
    EXPECT_EQ(cost.at("cells"), (std::vector<int>{16, 16, 16}));
    EXPECT_GT(cost.at("steps_per_s").get<double>(), 0.0);
    EXPECT_DOUBLE_EQ(cost.at("target_steps_per_s"), 50.0);
    EXPECT_TRUE(cost.at("force_error_share").is_null());
    double sum = 0.0;
    for (const auto& [stage, ms] : cost.at("stages_ms").items()) sum += ms.get<double>();
    EXPECT_GT(cost.at("stages_ms").at("pressure").get<double>(), 0.0);
    EXPECT_NEAR(cost.at("step_ms"), sum, 1e-9 * sum);
    // However busy the machine: each millisecond's tick is run, or left out and counted; none is lost in between.
    const int ticks = status.at("haptics").at("ticks"), missed = status.at("haptics").at("missed");
    EXPECT_GT(ticks, 0);
    // The hand's loop begins once there is a fluid to be made ready, and the show when it is.
    EXPECT_GE(ticks + missed, 1000) << status.dump(2);
    EXPECT_LE(ticks + missed, 1000.0 * uptime + 50.0) << status.dump(2);
}

TEST(Run, EndsCleanlyWithinTwoSecondsOfBeingTold) {
    for (const int signal : {SIGTERM, SIGINT}) {
        const ScratchFolder folder;
        Program run(eddy_command(small_run({"--run-dir", folder / "run", "--record", folder / "record"})));
        const auto patience = SteadyClock::now() + 30s;
        while (!std::filesystem::exists(folder / "run/status.json") && SteadyClock::now() < patience)
            std::this_thread::sleep_for(10ms);
        ASSERT_TRUE(std::filesystem::exists(folder / "run/status.json")) << "it never began";
        const auto told = SteadyClock::now();
        run.send(signal);
        const Ended ended = run.wait();
        EXPECT_LT(std::chrono::duration<double>(SteadyClock::now() - told).count(), 2.0);
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_EQ(lines_of(ended.out).size(), 10u) << ended.out;
        EXPECT_EQ(read_all(folder / "record/force.csv").back(), '\n');
        EXPECT_FALSE(std::filesystem::exists(folder / "run/status.json.new"));
    }
}

}  // namespace
}  // namespace eddy
