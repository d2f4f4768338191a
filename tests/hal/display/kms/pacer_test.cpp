#include "hal/display/kms/pacer.h"

#include <gtest/gtest.h>

namespace eddy::kms {
namespace {

using namespace std::chrono_literals;

TEST(Pacer, LetsADriverAloneThatWaitsForTheRefresh) {
    Pacer pacer(16667us);
    for (int i = 1; i <= 1000; ++i) {
        // The show draws every second refresh, and now and then a stamp is early.
        const Instant jitter = i % 20 == 0 ? -4000us : 0us;
        pacer.flipped(i * 33334us - 10ms, i * 33334us + jitter);
        EXPECT_FALSE(pacer.next());
    }
    EXPECT_TRUE(pacer.driver_paces());
}

TEST(Pacer, NoticesWithinThirtyFramesThatADriverDoesNot) {
    Pacer pacer(13333us);  // 75 Hz
    int frames = 0;
    for (Instant t{0}; pacer.driver_paces() && frames < 100; ++frames)
        pacer.flipped(t, t += 10130us);  // 98.7 a second
    EXPECT_LE(frames, 30);
}

TEST(Pacer, ThenSpacesTheFramesByThePeriod) {
    Pacer pacer(13333us);
    Instant t{0};
    while (pacer.driver_paces()) pacer.flipped(t, t += 1ms);
    const Instant start = *pacer.next();
    for (int i = 0; i < 75; ++i) {
        t = *pacer.next() + 2ms;  // the loop comes by a little late each time
        pacer.flipped(t, t + 1ms);
    }
    EXPECT_NEAR(Seconds(*pacer.next() - start).count(), 1.0, 0.002) << "lateness does not add up";
    t += 1s;  // a pause
    pacer.flipped(t, t + 1ms);
    EXPECT_EQ(*pacer.next(), t + 1ms + 13333us) << "and no frames are made up for";
}

TEST(Pacer, AFrameIsLateAfterOneAndAHalfPeriods) {
    Pacer pacer(16667us);
    pacer.flipped(0ms, 16ms);
    EXPECT_FALSE(pacer.was_late());
    pacer.flipped(20ms, 44ms);
    EXPECT_FALSE(pacer.was_late());
    pacer.flipped(45ms, 75ms);
    EXPECT_TRUE(pacer.was_late());
    pacer.flipped(50ms, 95ms);
    EXPECT_FALSE(pacer.was_late()) << "it stood behind the one before";
}

}  // namespace
}  // namespace eddy::kms
