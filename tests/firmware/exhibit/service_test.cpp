#include "firmware/exhibit/service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware/exhibit/manager_socket.h"

namespace eddy {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using namespace std::chrono_literals;

// WatchdogSec of eddy.service.
constexpr Seconds kPeriod{8.0};

class ServiceTest : public testing::Test {
  protected:
    /// How often, since the last call. (The manager reads all the time, or its queue is full.)
    long fed() {
        read();
        return std::exchange(fed_, 0);
    }
    void read() {
        const auto all = manager_.messages();
        fed_ += std::count(all.begin(), all.end(), "WATCHDOG=1");
    }
    /// Ten frames a second from `from` to `until`; the hand's loop gets on until `hand_until`.
    void run(Instant from, Instant until, Instant hand_until) {
        for (Instant t = from; t < until; t += 100ms) {
            service_.heartbeats().see(Part::Render, ++frames_, t);
            if (t < hand_until) ticks_ += 100;
            service_.heartbeats().see(Part::Haptic, ticks_, t);
            service_.go_on(t);
            read();
        }
    }
    void begin() {
        service_.heartbeats().expect(Part::Render, 0s);
        service_.heartbeats().expect(Part::Haptic, 0s);
        service_.first_frame(0s);
        manager_.messages();
    }
    ScratchFolder folder_;
    ManagerSocket manager_{folder_ / "notify"};
    ServiceNotify notify_{folder_ / "notify"};
    Service service_{notify_, kPeriod};
    std::uint64_t frames_ = 0, ticks_ = 0;
    long fed_ = 0;
};

TEST_F(ServiceTest, IsReadyWithTheFirstFrameAndNotBefore) {
    service_.preparing(0s, "shaders");
    service_.go_on(1s);
    EXPECT_THAT(manager_.messages(), ElementsAre("STATUS=shaders", "EXTEND_TIMEOUT_USEC=180000000"));
    service_.first_frame(30s);
    EXPECT_THAT(manager_.messages(), ElementsAre("READY=1", "WATCHDOG=1"));
}

TEST_F(ServiceTest, ASlowPreparationIsGivenMoreTimeAsLongAsItGetsOn) {
    for (Instant t = 0s; t < 600s; t += 60s) {
        service_.preparing(t, "shaders");
        EXPECT_THAT(manager_.messages(), Contains("EXTEND_TIMEOUT_USEC=180000000")) << t.count();
    }
}

TEST_F(ServiceTest, FeedsTheWatchdogFourTimesAPeriodWhileAllGetOn) {
    begin();
    run(0s, 80s, 80s);
    EXPECT_NEAR(static_cast<double>(fed()), 4.0 * 80.0 / kPeriod.count(), 2.0);
}

TEST_F(ServiceTest, NoticesAHangingHandWithinTenSecondsThoughThePictureMoves) {
    begin();
    run(0s, 20s, 20s);
    fed();
    Instant last_fed{0};
    for (Instant t = 20s; t < 40s; t += 100ms) {
        run(t, t + 100ms, 20s);
        if (fed() > 0) last_fed = t;
    }
    EXPECT_LE(last_fed + kPeriod, Seconds(20s + 10s)) << "the manager ends the program then";
    EXPECT_EQ(service_.heartbeats().hanging(40s), Part::Haptic);
}

TEST_F(ServiceTest, AHandThatWaitsForItsBusHasLongerButNotForEver) {
    begin();
    service_.heartbeats().give(Part::Haptic, 30s);
    run(0s, 20s, 0s);
    EXPECT_EQ(service_.heartbeats().hanging(20s), std::nullopt);
    EXPECT_GE(fed(), 8);
    run(20s, 31s, 0s);
    EXPECT_EQ(service_.heartbeats().hanging(31s), Part::Haptic);
    EXPECT_TRUE(service_.heartbeats().needs_restart(31s));
    run(31s, 32s, 32s);
    service_.heartbeats().give(Part::Haptic, Heartbeats::kPatience);
    EXPECT_EQ(service_.heartbeats().hanging(32s), std::nullopt);
    run(32s, 35s, 32s);
    EXPECT_EQ(service_.heartbeats().hanging(35s), Part::Haptic);
}

TEST_F(ServiceTest, ButtonAndLampsThatHangAreToldOfAndEndNothing) {
    begin();
    service_.heartbeats().expect(Part::Gpio, 0s);
    run(0s, 40s, 40s);
    EXPECT_GE(fed(), 15);
    EXPECT_EQ(service_.heartbeats().hanging(40s), Part::Gpio);
    run(40s, 80s, 40s);
    EXPECT_LE(fed(), 2) << "but the hand that hangs as well does";
}

TEST_F(ServiceTest, FilesThatNobodyCanReadAreToldOfAndEndNothing) {
    begin();
    service_.heartbeats().expect(Part::Config, 0s);
    run(0s, 40s, 40s);
    EXPECT_GE(fed(), 15);
    EXPECT_EQ(service_.heartbeats().hanging(40s), Part::Config);
    service_.heartbeats().expect(Part::Gpio, 0s);
    EXPECT_EQ(service_.heartbeats().hanging(40s), Part::Gpio) << "a stop input hangs on it";
    EXPECT_FALSE(service_.heartbeats().needs_restart(40s));
}

TEST_F(ServiceTest, AtTwoFramesASecondItLivesOn) {
    begin();
    for (Instant t = 0s; t < 60s; t += 500ms) {
        service_.heartbeats().see(Part::Render, ++frames_, t);
        service_.heartbeats().see(Part::Haptic, ticks_ += 500, t);
        service_.go_on(t);
        read();
    }
    EXPECT_GE(fed(), 20);
}

TEST_F(ServiceTest, MakingASceneTakesAsLongAsItTakes) {
    begin();
    run(0s, 10s, 10s);
    manager_.messages();
    service_.long_work_begins();
    EXPECT_THAT(manager_.messages(), ElementsAre("WATCHDOG_USEC=180000000"));
    service_.long_work_ends(100s);
    EXPECT_THAT(manager_.messages(), ElementsAre("WATCHDOG_USEC=8000000", "WATCHDOG=1"));
    run(100s, 101s, 101s);
    EXPECT_EQ(service_.heartbeats().hanging(101s), std::nullopt);
}

TEST_F(ServiceTest, LongWorkExcusesNoPartThatHungBefore) {
    begin();
    service_.heartbeats().expect(Part::Gpio, 0s);
    run(0s, 10s, 10s);
    ASSERT_EQ(service_.heartbeats().hanging(10s), Part::Gpio);
    service_.long_work_begins();
    service_.long_work_ends(100s);
    EXPECT_EQ(service_.heartbeats().hanging(100s), Part::Gpio) << "it has not answered";
    EXPECT_FALSE(service_.heartbeats().needs_restart(100s)) << "the others are excused";
    service_.heartbeats().see(Part::Gpio, 1, 101s);
    EXPECT_EQ(service_.heartbeats().hanging(101s), std::nullopt);
}

TEST_F(ServiceTest, LongWorkBegunTwiceIsToldOnce) {
    begin();
    service_.long_work_begins();
    service_.long_work_begins();
    EXPECT_THAT(manager_.messages(), ElementsAre("WATCHDOG_USEC=180000000"));
    service_.long_work_ends(1s);
    service_.long_work_ends(2s);
    EXPECT_THAT(manager_.messages(), ElementsAre("WATCHDOG_USEC=8000000", "WATCHDOG=1"));
}

TEST_F(ServiceTest, SaysALineWhenItIsAnotherAndOnceASecondAtMost) {
    service_.say(0s, "a");
    service_.say(2s, "a");
    service_.say(3s, "b");
    service_.say(3500ms, "c");
    service_.say(4s, "c");
    EXPECT_THAT(manager_.messages(), ElementsAre("STATUS=a", "STATUS=b", "STATUS=c"));
}

TEST_F(ServiceTest, WithoutAWatchdogNothingIsFed) {
    Service service(notify_, std::nullopt);
    service.first_frame(0s);
    service.go_on(10s);
    service.long_work_begins();
    service.long_work_ends(20s);
    EXPECT_THAT(manager_.messages(), ElementsAre("READY=1"));
}

}  // namespace
}  // namespace eddy
