#include "firmware/haptic/trace.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace eddy {
namespace {

TickRecord numbered(std::uint64_t n) {
    return {.t = Instant(n), .fluid_sequence = n};
}

TEST(TickTrace, HandsOutTicksInOrderAndOnce) {
    TickTrace trace(4);
    std::array<TickRecord, 3> out;
    std::uint64_t in = 0, expected = 0;
    for (int round = 0; round < 10; ++round) {  // wraps around the ring several times
        for (int i = 0; i < 3; ++i) trace.push(numbered(in++));
        ASSERT_EQ(trace.drain(out), 3U);
        for (const TickRecord& tick : out) EXPECT_EQ(tick.fluid_sequence, expected++);
    }
    EXPECT_EQ(trace.drain(out), 0U);
    EXPECT_EQ(trace.dropped(), 0U);
}

TEST(TickTrace, KeepsItsWholeCapacityAndCountsWhatItDrops) {
    TickTrace trace(5);
    for (std::uint64_t i = 0; i < 12; ++i) trace.push(numbered(i));
    std::array<TickRecord, 20> out;
    ASSERT_EQ(trace.drain(out), 5U);
    EXPECT_EQ(out[4].fluid_sequence, 4U);
    EXPECT_EQ(trace.dropped(), 7U);
}

TEST(TickTrace, LosesNothingItDoesNotCountBetweenThreads) {
    constexpr std::uint64_t kTicks = 100'000;
    TickTrace trace(64);
    std::atomic<bool> done{false};
    std::thread loop([&] {
        for (std::uint64_t i = 1; i <= kTicks; ++i) trace.push(numbered(i));
        done = true;
    });
    std::array<TickRecord, 16> out;
    std::uint64_t got = 0, last = 0, disorder = 0;
    for (bool finished = false; !finished;) {
        finished = done;  // before the drain, so that the last drain sees everything
        while (const std::size_t n = trace.drain(out)) {
            for (std::size_t i = 0; i < n; ++i) {
                disorder += out[i].fluid_sequence <= last || out[i].t != Instant(out[i].fluid_sequence);
                last = out[i].fluid_sequence;
            }
            got += n;
        }
    }
    loop.join();
    EXPECT_EQ(disorder, 0U);
    EXPECT_EQ(got + trace.dropped(), kTicks);
}

}  // namespace
}  // namespace eddy
