#include "firmware/loop_timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eddy {
namespace {

using std::chrono::microseconds;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Instant> ticks_of(const std::vector<int>& periods_us) {
    std::vector<Instant> ticks{Instant(0)};
    for (const int period : periods_us) ticks.push_back(ticks.back() + microseconds(period));
    return ticks;
}

TEST(LoopTiming, OfPeriodsThatTakeTurns) {
    std::vector<int> periods;
    for (int i = 0; i < 1000; ++i) periods.push_back(i % 2 == 0 ? 900 : 1100);
    const LoopTiming timing = loop_timing(ticks_of(periods));
    EXPECT_EQ(timing.ticks, 1001U);
    EXPECT_NEAR(timing.mean.count(), 1e-3, 1e-12);
    EXPECT_NEAR(timing.deviation.count(), 1e-4, 1e-12);
    EXPECT_NEAR(timing.longest.count(), 1.1e-3, 1e-12);
}

TEST(LoopTiming, OnePeriodInAThousandIsLongerThanItsP999) {
    std::vector<int> periods(10'000, 1000);
    for (int i = 0; i < 10; ++i) periods[static_cast<std::size_t>(i * 900)] = 2000 + i;
    EXPECT_NEAR(loop_timing(ticks_of(periods)).p999.count(), 1e-3, 1e-12);
    periods[9999] = 1700;  // the eleventh
    EXPECT_NEAR(loop_timing(ticks_of(periods)).p999.count(), 1.7e-3, 1e-12);
}

TEST(LoopTiming, EachLimitThatIsMissedHasItsLine) {
    const LoopTiming good{
        .ticks = 1000, .mean = Seconds(1.0099e-3), .p999 = Seconds(1.5e-3), .longest = Seconds(5e-3)};
    EXPECT_THAT(missed_limits(good, 950.0), ElementsAre());
    LoopTiming bad = good;
    bad.mean = Seconds(0.98e-3);
    EXPECT_THAT(missed_limits(bad, 950.0), ElementsAre(HasSubstr("mean period is 0.980 ms")));
    bad = good;
    bad.p999 = Seconds(1.6e-3);
    EXPECT_THAT(missed_limits(bad, 950.0), ElementsAre(HasSubstr("one period in a thousand")));
    bad = good;
    bad.longest = Seconds(5.1e-3);
    EXPECT_THAT(missed_limits(bad, 950.0), ElementsAre(HasSubstr("longest period is 5.10 ms")));
    EXPECT_THAT(missed_limits(good, 949.0), ElementsAre(HasSubstr("949 times a second")));
    EXPECT_THAT(missed_limits(LoopTiming{}, 0.0), testing::SizeIs(2)) << "of a loop that never ticked";
}

}  // namespace
}  // namespace eddy
