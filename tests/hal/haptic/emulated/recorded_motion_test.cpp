#include "hal/haptic/emulated/recorded_motion.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace eddy::emulated {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const AxisMap kAsIs("x,y,z");

std::string csv(const std::string& rows) {
    return "# a comment\nt_s,x_m,y_m,z_m\n" + rows;
}

void expect_refused(const std::string& text, const std::string& where, const std::string& what) {
    try {
        const RecordedMotion motion(text, "hand.csv", kAsIs, AtEnd::Hold);
        FAIL() << "taken: " << text;
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), StartsWith("hand.csv:" + where + ": "));
        EXPECT_THAT(error.what(), HasSubstr(what));
        EXPECT_THAT(error.what(), HasSubstr("; ")) << "says what to do";
    }
}

TEST(RecordedMotion, SaysWhatIsWrongInWhichLine) {
    expect_refused("", "0", "no motion");
    expect_refused("# only this\n", "1", "no motion");
    expect_refused("time,x,y,z\n", "1", "column names");
    expect_refused(csv("0,0,0\n"), "3", "four columns");
    expect_refused(csv("0,0,0,0\n1,0,0,0,5\n"), "4", "four columns");
    expect_refused(csv("0,0,0,0\n1,0,zero,0\n"), "4", "'zero' is not a number");
    expect_refused(csv("0,0,0,0\n1,0,,0\n"), "4", "'' is not a number");
    expect_refused(csv("0,0,0,0\n1,0,nan,0\n"), "4", "'nan' is not a number");
    expect_refused(csv("0,0,0,0\n1,0,0.1m,0\n"), "4", "'0.1m' is not a number");
    expect_refused(csv("0,0,0,0\n# pause\n0,0,0,0\n"), "5", "does not come after");
    expect_refused(csv("0,0,0,0\n1,0,35,0\n"), "4", "in metres");
    expect_refused(csv("0,0,0,0\n"), "3", "two samples");
}

TEST(RecordedMotion, ReadsWindowsLineEndsAndTimesThatBeginAnywhere) {
    const RecordedMotion motion("t_s,x_m,y_m,z_m\r\n10,0,0,0\r\n11,0.1,0,0\r\n", "m", kAsIs, AtEnd::Hold);
    EXPECT_DOUBLE_EQ(motion.duration().count(), 1.0);
    EXPECT_NEAR(motion.position_m(Seconds(0.5)).x, 0.05, 1e-15);
}

TEST(RecordedMotion, TurnsTheAxes) {
    const RecordedMotion motion(csv("0,0.1,0.2,0.3\n1,0.1,0.2,0.3\n"), "m", AxisMap("x,z,-y"), AtEnd::Hold);
    EXPECT_EQ(motion.position_m(Seconds(0.0)), glm::dvec3(0.1, 0.3, -0.2));
}

TEST(RecordedMotion, ReproducesACubicExactly) {
    const auto cubic = [](double t) { return 0.01 + 0.2 * t - 0.7 * t * t + 0.5 * t * t * t; };
    std::string rows;
    double t = 0.0;
    for (int i = 0; i < 30; ++i) {
        rows += fmt::format("{},{},{},{}\n", t, cubic(t), -cubic(t), 0.5 * t);
        t += 0.01 * (1 + i % 4);  // uneven
    }
    const RecordedMotion motion(csv(rows), "m", kAsIs, AtEnd::Hold);
    for (double s = 0.0; s < motion.duration().count(); s += 0.0007) {
        EXPECT_NEAR(motion.position_m(Seconds(s)).x, cubic(s), 1e-14);
        EXPECT_NEAR(motion.position_m(Seconds(s)).z, 0.5 * s, 1e-14);
    }
}

/// Samples of a hand that goes round and ends elsewhere than it began.
RecordedMotion wave(AtEnd at_end) {
    std::string rows;
    for (int i = 0; i <= 400; ++i) {
        const double t = 0.01 * i;
        rows +=
            fmt::format("{},{},{},{}\n", t, 0.03 * std::sin(4.5 * t), 0.02 * std::cos(3.1 * t), 0.005 * t);
    }
    return RecordedMotion(csv(rows), "m", kAsIs, at_end);
}

/// Largest change of velocity between neighbouring steps of h [m/s].
double largest_velocity_step(const HandMotion& motion, double from, double to, double h) {
    double largest = 0.0;
    for (double t = from; t < to; t += h) {
        const glm::dvec3 before = motion.position_m(Seconds(t)) - motion.position_m(Seconds(t - h));
        const glm::dvec3 after = motion.position_m(Seconds(t + h)) - motion.position_m(Seconds(t));
        largest = std::max(largest, glm::length(after - before) / h);
    }
    return largest;
}

TEST(RecordedMotion, HasNoJumpOfVelocityAtSamplesNorWhereItLoops) {
    const RecordedMotion motion = wave(AtEnd::Loop);
    // Continuous velocity: its change over a step shrinks with the step, here as 1 m/s2 times h.
    EXPECT_LT(largest_velocity_step(motion, 0.1, 15.0, 1e-4), 3e-4);
}

TEST(RecordedMotion, LoopsForEverWithinWhatWasRecorded) {
    const RecordedMotion motion = wave(AtEnd::Loop);
    for (double t = 0.0; t < 100.0; t += 0.01) {
        const glm::dvec3 p = motion.position_m(Seconds(t));
        ASSERT_LE(std::abs(p.x), 0.0301);
        ASSERT_LE(std::abs(p.z - 0.01), 0.0101);
    }
    EXPECT_NE(motion.position_m(Seconds(70.0)), motion.position_m(Seconds(71.0)));
}

TEST(RecordedMotion, HoldsItsLastPosition) {
    const RecordedMotion motion = wave(AtEnd::Hold);
    EXPECT_EQ(motion.position_m(Seconds(4.0)), motion.position_m(Seconds(400.0)));
    EXPECT_EQ(motion.position_m(Seconds(-1.0)), motion.position_m(Seconds(0.0)));
}

TEST(RecordedMotion, ReadsTheRecordingsOfRealHands) {
    const char* folder = std::getenv("EDDY_MOTIONS");
    if (folder == nullptr) GTEST_SKIP() << "skipped: EDDY_MOTIONS names no folder of recordings";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".csv") continue;
        ++files;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        const RecordedMotion motion(text.str(), entry.path().string(), AxisMap("x,z,-y"), AtEnd::Loop);
        EXPECT_GT(motion.duration().count(), 1.0);
        for (double t = 0.0; t < 2 * motion.duration().count(); t += 0.001) {
            const glm::dvec3 p = motion.position_m(Seconds(t));
            ASSERT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 0.060)
                << entry.path() << " at " << t;
        }
        // 34 m/s2 is the largest second difference of the samples (noise of the tracking); cubics may double
        // it.
        EXPECT_LT(largest_velocity_step(motion, 0.1, 2 * motion.duration().count(), 1e-3), 0.1)
            << entry.path();
    }
    EXPECT_GT(files, 0) << "no .csv in " << folder;
}

}  // namespace
}  // namespace eddy::emulated
