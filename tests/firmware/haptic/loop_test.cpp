#include "firmware/haptic/loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <thread>
#include <vector>

#include "scripted_device.h"
#include "tests/allocations.h"
#include "tests/mocks/mock_haptic_device.h"

namespace eddy {
namespace {

using std::chrono::milliseconds;
using ::testing::_;
using ::testing::InSequence;
using ::testing::NiceMock;
using ::testing::Return;

const HapticOrders kOrders{.enabled = true,
                           .tank_from_device = {.centre_m = glm::dvec3(0.1), .scale = 1.0},
                           .lowest_m = glm::dvec3(0.0),
                           .highest_m = glm::dvec3(0.2)};

/// A loop, its device, and a fluid of 50 Hz that drags the body with 10 N s/m.
struct Rig {
    ScriptedDevice device;
    HapticExchange exchange;
    TickTrace trace{10'000};
    HapticLoop loop{device, exchange, trace};
    std::uint64_t sequence = 0;

    Rig() {
        device.path = [](Seconds t) {
            return 0.03 * glm::dvec3(std::sin(7.0 * t.count()), std::cos(5.0 * t.count()), 0.0);
        };
        exchange.orders.publish(kOrders);
    }
    void fluid_step() {
        const PoseSnapshot& pose = exchange.pose.newest();
        exchange.fluid.publish({.force_n = -10.0 * pose.velocity_m_s,
                                .sequence = ++sequence,
                                .computed_for = pose.time,
                                .fluid_period = Seconds(0.020)});
    }
    void run(int ticks) {
        for (int i = 1; i <= ticks; ++i) {
            if (i % 20 == 1) fluid_step();
            loop.tick(milliseconds(i));
        }
    }
    std::vector<TickRecord> records() {
        std::vector<TickRecord> all(10'000);
        all.resize(trace.drain(all));
        return all;
    }
};

/// Virtual time whose sleeps overshoot where told to, and which raises `stop` when its time is up.
class SleepyClock final : public Clock {
  public:
    std::map<Instant, Instant> oversleep;  ///< due time -> how much too long
    Instant stop_at{0};
    std::atomic<bool> stop{false};

    /// Something takes that long.
    void spend(Instant time) { now_ += time; }

    Instant now() const override { return now_; }
    void sleep_until(Instant t) override {
        now_ = std::max(now_, t);
        if (const auto it = oversleep.find(t); it != oversleep.end()) now_ += it->second;
        if (now_ >= stop_at) stop = true;
    }

  private:
    Instant now_{0};
};

TEST(HapticLoop, PollsReadsAndCommandsInThisOrder) {
    NiceMock<MockHapticDevice> device;
    HapticExchange exchange;
    TickTrace trace(10);
    HapticLoop loop(device, exchange, trace);
    ON_CALL(device, state()).WillByDefault(Return(HapticState::Ready));
    InSequence order;
    EXPECT_CALL(device, poll(Instant(milliseconds(7))));
    EXPECT_CALL(device, read()).WillOnce(Return(std::nullopt));
    EXPECT_CALL(device, command(glm::dvec3(0.0)));
    loop.tick(milliseconds(7));
}

TEST(HapticLoop, FeelsTheFluidThroughTheWholeChain) {
    Rig rig;
    rig.run(3000);
    // Drag opposes the motion: over the settled seconds the hand loses energy at about 10 v^2.
    double work = 0.0, expected = 0.0;
    for (const TickRecord& tick : rig.records()) {
        if (tick.t < milliseconds(1200)) continue;
        work -= 1e-3 * glm::dot(tick.sent_force_n, tick.velocity_m_s);
        expected += 1e-3 * 10.0 * glm::dot(tick.velocity_m_s, tick.velocity_m_s);
    }
    EXPECT_NEAR(work / expected, 1.0, 0.05);  // 25 ms of hold and filter at 1.1 Hz: cos(0.17) = 0.985
}

TEST(HapticLoop, RecordsEveryTickAsItHappened) {
    Rig rig;
    rig.run(100);
    const std::vector<TickRecord> ticks = rig.records();
    ASSERT_EQ(ticks.size(), 100U);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        EXPECT_EQ(ticks[i].t, Instant(milliseconds(i + 1)));
        EXPECT_EQ(ticks[i].position_m, rig.device.path(ticks[i].t));
        EXPECT_EQ(ticks[i].fluid_sequence, i / 20 + 1);
        EXPECT_EQ(ticks[i].fluid_age, Instant(milliseconds(i % 20)));
        EXPECT_EQ(ticks[i].reason, GateReason::Starting);
    }
    EXPECT_EQ(ticks[45].fluid_lag,
              Instant(milliseconds(6)));  // tick 46 holds the answer to the pose of tick 40
    EXPECT_EQ(ticks.back().sent_force_n, rig.device.commanded_n);
}

TEST(HapticLoop, ReportsHowLateTheFluidsAnswersAre) {
    for (const int late_ms : {5, 45}) {
        Rig rig;
        for (int i = 1; i <= 1000; ++i) {
            if (i % 20 == 1)
                rig.exchange.fluid.publish({.sequence = ++rig.sequence,
                                            .computed_for = milliseconds(i - late_ms),
                                            .fluid_period = Seconds(0.020)});
            rig.loop.tick(milliseconds(i));
        }
        EXPECT_NEAR(rig.exchange.report.newest().fluid_lateness.count(), 1e-3 * late_ms, 1e-4);
        // What comes after ten seconds of compiling says nothing of the next.
        rig.exchange.fluid.publish({.sequence = ++rig.sequence, .computed_for = milliseconds(1000)});
        rig.loop.tick(milliseconds(11'000));
        EXPECT_NEAR(rig.exchange.report.newest().fluid_lateness.count(), 1e-3 * late_ms, 1e-4);
    }
}

TEST(HapticLoop, ReportsItselfForTheStatusPage) {
    Rig rig;
    rig.run(50);
    rig.exchange.fluid.publish(
        {.force_n = glm::dvec3(std::numeric_limits<double>::quiet_NaN()), .sequence = 99});
    rig.loop.tick(milliseconds(51));
    const LoopReport& report = rig.exchange.report.newest();
    EXPECT_EQ(report.ticks, 51U);
    EXPECT_EQ(report.gate.non_finite, 1U);
    EXPECT_EQ(report.reason, GateReason::NotFinite);
    EXPECT_EQ(report.device, HapticState::Ready);
}

TEST(HapticLoop, ATickAllocatesNothing) {
    Rig rig;
    rig.run(10);
    const std::uint64_t before = allocations();
    rig.run(2000);
    rig.device.answers = false;  // trouble allocates nothing either
    rig.run(50);
    EXPECT_EQ(allocations(), before);
}

TEST(HapticLoop, IsRepeatableBitForBitOnTheSteppedClock) {
    const auto run = [] {
        Rig rig;
        SteppedClock clock;
        std::atomic<bool> stop{false};
        rig.device.path =
            [&](Seconds t) {  // the fluid and the end ride on the device's calls, at fixed virtual times
                if (std::llround(t.count() * 1000.0) % 20 == 0) rig.fluid_step();
                if (t.count() > 1.9995) stop = true;
                return 0.03 * glm::dvec3(std::sin(7.0 * t.count()), std::cos(5.0 * t.count()), 0.0);
            };
        rig.loop.run(clock, stop);
        return rig.records();
    };
    const std::vector<TickRecord> a = run(), b = run();
    ASSERT_EQ(a.size(), 2001U + kClosingTicks);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_GT(glm::length(a[2000].sent_force_n), 0.1);
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].t, b[i].t);
        for (const auto member :
             {&TickRecord::position_m, &TickRecord::velocity_m_s, &TickRecord::raw_force_n,
              &TickRecord::filtered_force_n, &TickRecord::sent_force_n})
            ASSERT_EQ(std::memcmp(&(a[i].*member), &(b[i].*member), sizeof(glm::dvec3)), 0) << i;
    }
}

TEST(HapticLoop, ALateTickCountsForTheTimeThatReallyPassed) {
    Rig rig;
    rig.exchange.fluid.publish({.force_n = {0.5, 0.0, 0.0}, .sequence = 1, .fluid_period = Seconds(0.020)});
    for (const int t : {1, 2, 6}) rig.loop.tick(milliseconds(t));  // 1 ms for the first tick, then 1 and 4
    const double exact = 0.5 * (1.0 - std::exp(-2.0 * std::numbers::pi * 12.5 * 0.006));
    EXPECT_NEAR(rig.records().back().filtered_force_n.x, exact, 1e-14);
}

TEST(HapticLoop, KeepsToAFixedGridAndSkipsWhatItMissed) {
    Rig rig;
    SleepyClock clock;
    clock.oversleep = {
        {milliseconds(5), std::chrono::microseconds(300)},     // late, but not worth a count
        {milliseconds(10), std::chrono::microseconds(700)},    // late
        {milliseconds(20), std::chrono::microseconds(3200)}};  // late, and 21, 22 and 23 have passed
    clock.stop_at = milliseconds(30);
    rig.loop.run(clock, clock.stop);

    std::vector<Instant> expected;
    for (int i = 0; i <= 30 + kClosingTicks; ++i) {
        if (i >= 21 && i <= 23) continue;
        expected.push_back(milliseconds(i));
        if (const auto it = clock.oversleep.find(milliseconds(i)); it != clock.oversleep.end())
            expected.back() += it->second;
    }
    std::vector<Instant> began;
    for (const TickRecord& tick : rig.records()) began.push_back(tick.t);
    EXPECT_EQ(began, expected);

    const LoopReport& report = rig.exchange.report.newest();
    EXPECT_EQ(report.late, 2U);
    EXPECT_EQ(report.missed, 3U);
    EXPECT_EQ(report.worst_late, Instant(std::chrono::microseconds(3200)));
}

TEST(HapticLoop, LeavesTheCoreToOthersForAsLongAsATickTook) {
    Rig rig;
    SleepyClock clock;
    clock.stop_at = milliseconds(100);
    rig.device.path = [&](Seconds) {
        clock.spend(std::chrono::microseconds(1700));
        return glm::dvec3(0.0);
    };
    rig.loop.run(clock, clock.stop);
    const std::vector<TickRecord> ticks = rig.records();
    for (std::size_t i = 0; i < ticks.size(); ++i)
        EXPECT_EQ(ticks[i].t, Instant(milliseconds(4)) * static_cast<int>(i));
    const LoopReport& report = rig.exchange.report.newest();
    EXPECT_EQ(report.missed, 3 * (report.ticks - 1));
    EXPECT_EQ(report.late, 0U);
}

TEST(HapticLoop, LooksAHundredTimesASecondForADeviceThatIsNotThere) {
    Rig rig;
    SleepyClock clock;
    clock.stop_at = milliseconds(100);
    rig.device.is = HapticState::Absent;
    rig.device.path = [](Seconds) { return glm::dvec3(0.0); };
    rig.loop.run(clock, clock.stop);
    const std::vector<TickRecord> ticks = rig.records();
    ASSERT_EQ(ticks.size(), 11U + kClosingTicks);
    for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].t, static_cast<int>(i) * kAbsentTick);
    EXPECT_EQ(rig.exchange.report.newest().missed, 0U);
}

TEST(HapticLoop, SendsZeroForTenTicksAfterStop) {
    Rig rig;
    SleepyClock clock;
    clock.stop_at = milliseconds(60);
    rig.exchange.fluid.publish({.force_n = glm::dvec3(3.0), .sequence = 1, .fluid_period = Seconds(0.020)});
    rig.loop.run(clock, clock.stop);
    EXPECT_EQ(rig.device.zeros_in_a_row, kClosingTicks);
    EXPECT_GE(kClosingTicks, 10);
    // The report keeps how the force was before the loop was told to end.
    EXPECT_EQ(rig.exchange.report.newest().reason, GateReason::Starting);
}

TEST(HapticLoop, RunsBesideAFluidThreadOnTheRealClock) {
    Rig rig;
    RealClock clock;
    std::atomic<bool> stop{false};
    std::thread loop([&] { rig.loop.run(clock, stop); });
    std::vector<TickRecord> records(1000);
    std::size_t drained = 0;
    while (rig.exchange.report.newest().ticks < 100) {  // as long as the machine needs; no wall-clock limit
        rig.fluid_step();
        drained += rig.trace.drain(records);
        std::this_thread::yield();
    }
    stop = true;
    loop.join();
    drained += rig.trace.drain(records);
    EXPECT_EQ(drained + rig.trace.dropped(), rig.exchange.report.newest().ticks);
    EXPECT_GE(rig.device.zeros_in_a_row, kClosingTicks);
}

}  // namespace
}  // namespace eddy
