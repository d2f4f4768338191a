#include "firmware/haptic/dead_man.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "firmware/haptic/law.h"

namespace eddy {
namespace {

using std::chrono::milliseconds;

struct Holder {
    DeadMan dead_man;
    HapticInput in{.device = HapticState::Ready};
    std::uint8_t buttons = 0;

    GateReason at(const glm::dvec3& position_m) {
        in.now += milliseconds(1);
        in.reading = HandleReading{.position_m = position_m, .buttons = buttons, .taken_at = in.now};
        return dead_man(in);
    }
    GateReason rest(int ticks, const glm::dvec3& position_m = glm::dvec3(0.01)) {
        GateReason reason = GateReason::Open;
        for (int i = 0; i < ticks; ++i) reason = at(position_m);
        return reason;
    }
};

TEST(DeadMan, AHandleThatDoesNotMoveForFiveSecondsIsHeldByNobody) {
    Holder holder;
    EXPECT_EQ(holder.rest(5000), GateReason::Open);
    EXPECT_EQ(holder.rest(1), GateReason::Released);
    EXPECT_EQ(holder.dead_man.counters().released, 1U);
    EXPECT_EQ(holder.rest(60'000), GateReason::Released);
    EXPECT_EQ(holder.dead_man.counters().released, 1U);
}

TEST(DeadMan, AHandThatTremblesHoldsOn) {
    Holder holder;
    // 0.3 mm to and fro at 9 Hz, less than a fingertip is wide.
    for (int ms = 0; ms < 60'000; ++ms)
        ASSERT_EQ(holder.at({0.00015 * std::sin(2.0 * 3.14159 * 9.0 * 1e-3 * ms), 0.0, 0.0}),
                  GateReason::Open);
}

TEST(DeadMan, TakenUpOrPressedIsHeldAgain) {
    Holder holder;
    holder.rest(6000);
    EXPECT_EQ(holder.at(glm::dvec3(0.01, 0.01, 0.0104)), GateReason::Released) << "a shake of the building";
    EXPECT_EQ(holder.at(glm::dvec3(0.01, 0.01, 0.0106)), GateReason::Open);
    EXPECT_EQ(holder.rest(5001), GateReason::Released);
    holder.buttons = 1;
    EXPECT_EQ(holder.rest(1), GateReason::Open);
}

TEST(DeadMan, TakenUpWithinTwoSecondsItWasAFalseAlarm) {
    for (const bool soon : {true, false}) {
        Holder holder;
        holder.rest(5001);
        holder.rest(soon ? 1990 : 2010);
        holder.rest(1, glm::dvec3(0.02));
        EXPECT_EQ(holder.dead_man.counters().released, 1U);
        EXPECT_EQ(holder.dead_man.counters().false_alarms, soon ? 1U : 0U);
    }
}

TEST(DeadMan, ADeviceThatWasAwayBeginsAnew) {
    Holder holder;
    holder.rest(4000);
    holder.in.device = HapticState::Absent;
    holder.in.reading.reset();
    holder.dead_man(holder.in);
    holder.in.device = HapticState::Ready;
    EXPECT_EQ(holder.rest(5000), GateReason::Open);
    EXPECT_EQ(holder.rest(1), GateReason::Released);
}

TEST(DeadMan, TheStopInputHoldsUntilSomebodyRestartsAndItIsNotPressed) {
    Holder holder;
    EXPECT_EQ(holder.at({}), GateReason::Open);
    holder.in.orders.stop = true;
    EXPECT_EQ(holder.at({}), GateReason::Stopped);
    holder.in.orders.restarts = 1;
    EXPECT_EQ(holder.at({}), GateReason::Stopped) << "still pressed";
    holder.in.orders.stop = false;
    EXPECT_EQ(holder.rest(100), GateReason::Stopped) << "let go is not restarted";
    holder.in.orders.resets = 1;
    EXPECT_EQ(holder.at({}), GateReason::Stopped) << "nor is a fault that was forgiven";
    holder.in.orders.restarts = 2;
    EXPECT_EQ(holder.at({}), GateReason::Open);
}

/// Recorded hands never let go.
TEST(DeadMan, TakesNoRecordedHandForNone) {
    const char* folder = std::getenv("EDDY_MOTIONS");
    if (!folder) GTEST_SKIP() << "EDDY_MOTIONS names no folder with recordings";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".csv") continue;
        std::ifstream file(entry.path());
        std::string line;
        DeadMan dead_man;
        HapticInput in{.device = HapticState::Ready};
        double last_s = 0.0;
        while (std::getline(file, line)) {
            double t = 0.0, x = 0.0, y = 0.0, z = 0.0;
            char comma = 0;
            std::istringstream numbers(line);
            if (!(numbers >> t >> comma >> x >> comma >> y >> comma >> z)) continue;
            in.now = std::chrono::duration_cast<Instant>(Seconds(t));
            in.reading = HandleReading{.position_m = {x, y, z}, .taken_at = in.now};
            dead_man(in);
            last_s = t;
        }
        EXPECT_GT(last_s, 5.0) << entry.path();
        EXPECT_EQ(dead_man.counters().released, 0U) << entry.path() << ", " << last_s << " s";
    }
}

}  // namespace
}  // namespace eddy
