#include "hal/haptic/emulated/emulated_falcon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hal/haptic/falcon/ftdi.h"
#include "tests/hal/haptic/falcon/rig.h"

namespace eddy::emulated {
namespace {

using namespace falcon;
using namespace std::chrono_literals;

/// Talks to the emulated device without the driver.
struct Bench {
    explicit Bench(BoardSettings settings) : device(still(), {}, settings) { device.poll(now); }

    void wait(Instant time) {
        const Instant end = now + time;
        while (now < end) {
            device.poll(now += 100us);
            Packet packet;
            while (device.take_in(packet)) {
                ++packets;
                sizes.push_back(packet.size);
                for (const std::uint8_t byte : strip_status(packet).bytes)
                    heard.push_back(static_cast<char>(byte));
            }
        }
    }
    Transfer ask(const ControlRequest& request) {
        device.submit_control(request);
        wait(1ms);
        return device.control();
    }
    void say(const std::vector<std::uint8_t>& bytes) { device.submit_out(bytes); }
    std::string answer(Instant time) {
        heard.clear();
        wait(time);
        return heard;
    }

    Instant now{0};
    EmulatedFalcon device;
    std::string heard;
    std::vector<std::size_t> sizes;
    int packets = 0;
};

void to_pic(Bench& bench) {
    bench.ask(baud_9600());
    bench.ask(set_dtr(false));
    bench.ask(set_dtr(true));
}

TEST(EmulatedChip, SendsEmptyPacketsAtEachLatencyPeriod) {
    Bench bench(cold());
    bench.wait(160ms);
    EXPECT_NEAR(bench.packets, 10, 1) << "16 ms from power on";
    bench.ask(set_latency(1));
    bench.packets = 0;
    bench.wait(100ms);
    EXPECT_NEAR(bench.packets, 100, 2);
    for (const std::size_t size : bench.sizes) EXPECT_EQ(size, 2U);
}

TEST(EmulatedChip, RefusesRequestsItDoesNotKnow) {
    Bench bench(cold());
    EXPECT_EQ(bench.ask({0x40, 0x42, 0, 0}), Transfer::Failed);
    EXPECT_EQ(bench.ask({0x40, 9, 0, 0}), Transfer::Failed) << "no latency of 0 ms";
    EXPECT_EQ(bench.ask({0xC0, 5, 0, 0}), Transfer::Failed);
    EXPECT_EQ(bench.ask(set_latency(1)), Transfer::Done);
    ASSERT_EQ(bench.device.requests().size(), 4U);
    EXPECT_EQ(bench.device.requests()[3].request, set_latency(1));
}

TEST(EmulatedChip, TakesTheTimeOfTheSerialLine) {
    Bench bench({.turnaround = 0us});
    bench.ask(baud_1500000());
    bench.ask(flush_on('>'));
    const Instant begin = bench.now;
    const Frame null = encode(Command{});
    bench.say({null.begin(), null.end()});
    while (bench.heard.size() < kFrameBytes && bench.now < begin + 10ms) bench.wait(10us);
    // 60 us on the bus each way, and 16 bytes of 10 bits each way at 1.5 MBd; asked every 100 us.
    EXPECT_NEAR(Seconds(bench.now - begin).count() * 1e6, 2 * 60.0 + 2 * 16 * 10 / 1.5, 100.0);
}

TEST(EmulatedChip, SplitsLongAnswersIntoPackets) {
    Bench bench(cold());
    to_pic(bench);
    bench.ask(set_dtr(false));
    bench.ask(baud_142857());
    bench.say({0x41});
    EXPECT_EQ(bench.answer(50ms), "A");
    bench.sizes.clear();
    const auto image = synthetic_firmware(100);
    bench.say({image.begin(), image.begin() + 100});
    EXPECT_EQ(bench.answer(100ms).size(), 100U);
    EXPECT_EQ(std::count(bench.sizes.begin(), bench.sizes.end(), 64U), 1)
        << "62 bytes at once, the rest with the timer";
}

TEST(EmulatedBoard, IsDeafWhileCold) {
    Bench bench(cold());
    bench.ask(baud_1500000());
    const Frame null = encode(Command{});
    bench.say({null.begin(), null.end()});
    EXPECT_EQ(bench.answer(50ms), "");
    bench.ask(baud_9600());
    bench.say({0x0A, 0x43, 0x0D});
    EXPECT_EQ(bench.answer(50ms), "") << "the PIC waits for DTR to rise";
}

TEST(EmulatedBoard, AnswersAsThePicOnceDtrRises) {
    Bench bench(cold());
    to_pic(bench);
    bench.say({0x0A, 0x43, 0x0D});
    EXPECT_EQ(bench.answer(50ms), "\x0A\x44\x2C\x0D");
    bench.ask(set_dtr(false));
    EXPECT_EQ(bench.device.board().state(), BoardState::FindingRate);
}

TEST(EmulatedBoard, UnderstandsNothingAtAWrongRate) {
    Bench bench(cold());
    to_pic(bench);
    bench.ask(baud_142857());
    bench.say({0x0A, 0x43, 0x0D});
    EXPECT_EQ(bench.answer(50ms), "");
    bench.ask(set_dtr(false));
    bench.ask(baud_9600());
    bench.say({0x41});
    EXPECT_EQ(bench.answer(50ms), "");
}

TEST(EmulatedBoard, GoesColdOnAWrongKey) {
    Bench bench(cold());
    to_pic(bench);
    bench.ask(set_dtr(false));
    bench.ask(baud_142857());
    bench.say({0x41, 0xAA, 0x09});
    bench.wait(50ms);
    EXPECT_EQ(bench.device.board().state(), BoardState::Cold);
}

TEST(EmulatedBoard, LetsItsFirmwareBeReplacedWhileItRuns) {
    Bench bench({});
    to_pic(bench);
    EXPECT_EQ(bench.device.board().state(), BoardState::Pic);
    bench.say({0x0A, 0x43, 0x0D});
    EXPECT_EQ(bench.answer(50ms), "\x0A\x44\x2C\x0D");
}

TEST(EmulatedBoard, DropsItsTorqueWhenTheHostFallsSilent) {
    Rig rig({}, {}, still(), {.hand = Hand::Arm});
    ASSERT_GE(rig.until(HapticState::Ready, 1000), 0);
    rig.run(200, {3.0, 0.0, 0.0});
    EXPECT_GT(rig.board().plant().position_m().x, 0.005);
    // The device lives on while the driver is not called at all.
    rig.device().poll(rig.now + 2s);
    EXPECT_LT(rig.board().plant().position_m().x, 0.001) << "the arm has pulled the handle back";
    EXPECT_EQ(rig.board().last_command(), Command{}) << "lamps off, too";
}

TEST(EmulatedFalcon, DoesTheSameEveryTime) {
    const auto trace = [] {
        Rig rig(unhomed(), {}, std::make_unique<Path>([](double t) {
                    return glm::dvec3(0.03 * std::sin(7 * t), 0.02 * std::cos(5 * t), -0.045 * std::cos(t));
                }),
                {.hand = Hand::Arm});
        std::vector<double> positions;
        for (int i = 0; i < 4000; ++i) {
            rig.tick({std::sin(0.01 * i), 0.5, -1.0});
            positions.push_back(rig.last.position_m.x + 10 * rig.last.position_m.y +
                                100 * rig.last.position_m.z);
        }
        EXPECT_GT(rig.readings, 1000);
        return positions;
    };
    EXPECT_EQ(trace(), trace());
}

}  // namespace
}  // namespace eddy::emulated
