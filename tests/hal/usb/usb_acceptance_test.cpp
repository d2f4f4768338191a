#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "tests/allocations.h"
#include "tests/hal/usb/usb_rig.h"

// What a Falcon must do before it may stand in a museum, through the real libusb, on virtual time.

namespace eddy {
namespace {

using namespace falcon;
using namespace std::chrono_literals;

TEST(FalconAcceptance, StartsFromColdInThreeSeconds) {
    UsbRig rig(cold(), with_firmware());  // as long as the longest of the public images
    const int ms = rig.until(HapticState::Homing, 5000);
    ASSERT_GE(ms, 0);
    EXPECT_LT(ms, 3000);  // measured 1.4 s
    RecordProperty("cold_start_ms", ms);
}

TEST(FalconAcceptance, AttachesToARunningDeviceInThreeTenthsOfASecond) {
    UsbRig rig({}, with_firmware());
    const int ms = rig.until(HapticState::Ready, 1000);
    ASSERT_GE(ms, 0);
    EXPECT_LT(ms, 300);  // measured 14 ms
    RecordProperty("warm_attach_ms", ms);
}

TEST(FalconAcceptance, ExchangesNineHundredAndFiftyTimesASecond) {
    UsbRig rig({.turnaround = 300us});
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    const auto before = rig.driver->counters();
    const auto began = std::chrono::steady_clock::now();
    std::vector<Instant> gaps;
    Instant last{0};
    for (int ms = 0; ms < 10000; ++ms) {
        rig.tick({1.0, 0.0, 0.0});
        if (rig.last.taken_at == last) continue;
        if (last > Instant(0)) gaps.push_back(rig.last.taken_at - last);
        last = rig.last.taken_at;
    }
    const Seconds wall = std::chrono::steady_clock::now() - began;
    const auto after = rig.driver->counters();
    EXPECT_GE(after.exchanges - before.exchanges, 9500U);
    EXPECT_EQ(after.timeouts, 0U);
    EXPECT_EQ(after.bad_bytes, 0U);
    ASSERT_GT(gaps.size(), 9000U);
    std::sort(gaps.begin(), gaps.end());
    EXPECT_LT(gaps[gaps.size() * 99 / 100], 1500us) << "the slowest hundredth of the exchanges";
    RecordProperty("exchanges_per_s", static_cast<int>((after.exchanges - before.exchanges) / 10));
    RecordProperty("path_microseconds_per_exchange", static_cast<int>(wall.count() * 1e6 / 10000));
}

TEST(FalconAcceptance, AllocatesNothingOfItsOwnWhileItRuns) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    ignore_allocations(&usb::InKernel::now);
    const std::size_t before = allocations();
    for (int ms = 0; ms < 1000; ++ms) {
        rig.tick({1.0, 0.0, 0.0});
        if (ms == 500) rig.board().faults.lost_replies = 2;
    }
    EXPECT_EQ(allocations(), before);
    ignore_allocations(nullptr);
}

// Whatever is asked for, whatever comes back: nothing beyond the motors' range, and nothing before homing.
TEST(FalconAcceptance, SendsNoTorqueOutOfRangeInAMillionFuzzedTicks) {
    const std::uint64_t seed = 20260601;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53 * 2.0 - 1.0; };
    Rig rig({}, with_firmware(20), std::make_unique<Path>([](double t) {
                return glm::dvec3(0.05 * std::sin(3 * t), 0.05 * std::cos(4 * t), 0.047 * std::sin(5 * t));
            }));
    const double inf = std::numeric_limits<double>::infinity();
    const double special[] = {std::nan(""), inf, -inf, 1e308, -1e308, 1e-320, 0.0, 1e5, -4e4};
    for (int i = 0; i < 1000000; ++i) {
        if (i % 100 == 0)
            rig.board().faults.encoder_error = {};  // poses that do not exist take long to give up
        const auto any = [&] {
            return random() % 4 == 0 ? special[random() % std::size(special)]
                                     : std::pow(10.0, 6 * uniform()) * uniform();
        };
        if (random() % 1000 == 0) {
            auto& faults = rig.board().faults;
            const auto some = [&] { return static_cast<int>(random() % 4); };
            switch (random() % 8) {
                case 0:
                    faults.lost_replies = some();
                    break;
                case 1:
                    faults.short_replies = some();
                    break;
                case 2:
                    // Not together with bytes that travel alone: the second reply then comes so late that it passes for
                    // the answer to the next command, and the driver hears of lost homing one command later.
                    faults.double_replies = rig.device().splits ? 0 : some();
                    break;
                case 3:
                    faults.garbage = some();
                    break;
                case 4:
                    faults.homing_lost = true;
                    break;
                case 5:
                    faults.encoder_error = {some() * 999, -some() * 999, some() * 5000};
                    break;
                case 6:
                    rig.device().splits = some() == 0 && faults.double_replies == 0;
                    break;
                default:
                    rig.device().unplug();
                    rig.run(static_cast<int>(random() % 20), {9.0, 9.0, 9.0});
                    rig.device().plug_in(some() != 0);
            }
        }
        rig.tick({any(), any(), any()});
    }
    EXPECT_GT(rig.board().frames(), 300000U);
    EXPECT_EQ(rig.board().largest_motor(), kMaxMotor);
    EXPECT_EQ(rig.board().largest_motor_unhomed(), 0);
}

/// Milliseconds from a fault until the motors get no torque: by the driver where the wire still carries what it says, else by the
/// firmware's own watchdog.
TEST(FalconAcceptance, LeavesNoTorqueTwentyMillisecondsAfterAFault) {
    const glm::dvec3 force(2.0, 0.0, 0.0);
    struct Fault {
        const char* name;
        bool wire_carries;
        std::function<void(UsbRig&)> inject;
    };
    const std::vector<Fault> faults{
        {"lost reply", true, [](UsbRig& rig) { rig.board().faults.lost_replies = 1; }},
        {"replies cut short", true, [](UsbRig& rig) { rig.board().faults.short_replies = 1000; }},
        {"dead line", true, [](UsbRig& rig) { rig.device().line_dead = true; }},
        {"slow replies", true, [](UsbRig& rig) { rig.board().faults.slow_reply = 50ms; }},
        {"homing lost", true, [](UsbRig& rig) { rig.board().faults.homing_lost = true; }},
        {"stall", false, [](UsbRig& rig) { rig.device().stalled = true; }},
        {"unplugged", false, [](UsbRig& rig) { rig.bus().unplug(*rig.port); }},
        {"program ends", true, [](UsbRig& rig) { rig.driver.reset(); }},
    };
    for (const auto& [name, wire_carries, inject] : faults) {
        UsbRig rig(wire_carries ? left_to_the_driver() : emulated::BoardSettings{});
        ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
        rig.run(50, force);
        ASSERT_NE(rig.board().last_command().motors, Axes{});
        inject(rig);
        int ms = 0;
        bool still_pushed = true;
        for (; still_pushed && ms < 100; ++ms) {
            if (rig.driver)
                rig.tick(force);
            else
                rig.bus().advance(rig.now += 1ms);
            still_pushed = rig.board().last_command().motors != Axes{};
        }
        EXPECT_LE(ms, 21) << name << ", counted in ticks; 20 ms is the watchdog of the emulated firmware";
        RecordProperty(std::string("zero_after_ms, ") + name, ms);
    }
}

TEST(FalconAcceptance, NoticesAnUnpluggedCableInATenthOfASecond) {
    UsbRig rig;
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.bus().unplug(*rig.port);
    const int ms = rig.until(HapticState::Absent, 100);
    ASSERT_GE(ms, 0);
    RecordProperty("unplug_noticed_ms", ms);
}

TEST(FalconAcceptance, ComesBackAThousandTimesOutOfAThousand) {
    const std::uint64_t seed = 4711;
    std::mt19937_64 random(seed);
    UsbRig rig({}, with_firmware(20), std::make_unique<Path>([](double t) {
                   return glm::dvec3(0.0, 0.0, 0.047 * std::sin(2 * M_PI * t));
               }));
    int back = 0, longest = 0;
    for (int cycle = 0; cycle < 1000; ++cycle) {
        rig.run(static_cast<int>(random() % 60), {1.0, 0.0, 0.0});
        rig.bus().unplug(*rig.port);
        ASSERT_GE(rig.until(HapticState::Absent, 100), 0) << "seed " << seed << ", cycle " << cycle;
        rig.run(static_cast<int>(random() % 30));
        rig.bus().replug(*rig.port, random() % 4 != 0);
        const int ms = rig.until(HapticState::Ready, 10000);
        ASSERT_GE(ms, 0) << "seed " << seed << ", cycle " << cycle << ": " << rig.driver->describe();
        longest = std::max(longest, ms);
        ++back;
    }
    EXPECT_EQ(back, 1000);
    EXPECT_EQ(rig.port->opened, 1001);
    RecordProperty("longest_return_ms", longest);
}

}  // namespace
}  // namespace eddy
