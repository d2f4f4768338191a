#include "hal/display/kms/flip_watch.h"

#include <gtest/gtest.h>

namespace eddy::kms {
namespace {

using namespace std::chrono_literals;
using Cure = FlipWatch::Cure;

TEST(FlipWatch, IsPatientForThreeSeconds) {
    FlipWatch watch;
    watch.expect(1s);
    EXPECT_EQ(watch.due(3999ms), Cure::None);
    EXPECT_EQ(watch.due(4s), Cure::SetMode);
    EXPECT_EQ(watch.due(4001ms), Cure::None) << "each is said once";
}

TEST(FlipWatch, TriesTheModeThenTheCardThenGivesUp) {
    FlipWatch watch;
    watch.expect(0s);
    EXPECT_EQ(watch.due(3s), Cure::SetMode);
    EXPECT_EQ(watch.due(6s), Cure::Reopen);
    EXPECT_EQ(watch.due(9s), Cure::GiveUp);
}

TEST(FlipWatch, OneFrameAfterACureIsNoCure) {
    FlipWatch watch;
    watch.expect(0s);
    EXPECT_EQ(watch.due(3s), Cure::SetMode);
    watch.flipped(4s);
    watch.expect(4s);
    EXPECT_EQ(watch.due(7s), Cure::Reopen);
}

TEST(FlipWatch, TenSecondsOfFramesAre) {
    FlipWatch watch;
    watch.expect(0s);
    EXPECT_EQ(watch.due(3s), Cure::SetMode);
    for (Instant t = 4s; t <= 14s; t += 1s) {
        watch.flipped(t);
        watch.expect(t);
    }
    EXPECT_EQ(watch.due(17s), Cure::SetMode);
}

TEST(FlipWatch, AFrameThatIsSentAgainIsOverdueSinceTheFirst) {
    FlipWatch watch;
    watch.expect(0s);
    watch.expect(2s);
    EXPECT_EQ(watch.due(3s), Cure::SetMode);
}

TEST(FlipWatch, WaitsForNothingWhenNothingWasSent) {
    FlipWatch watch;
    EXPECT_EQ(watch.due(1h), Cure::None);
    watch.expect(1h);
    watch.forget();
    EXPECT_EQ(watch.due(2h), Cure::None);
}

}  // namespace
}  // namespace eddy::kms
