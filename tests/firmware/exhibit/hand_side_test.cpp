#include "firmware/exhibit/hand_side.h"

#include <gmock/gmock.h>
#include <linux/capability.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tests/mocks/mock_haptic_device.h"

namespace eddy {
namespace {

using testing::_;
using testing::AtLeast;
using testing::NiceMock;
using testing::Return;

TEST(HandSide, WithoutADeviceDoesNothingAndSaysSo) {
    HandSide hand(nullptr, "none", {}, {});
    EXPECT_FALSE(hand.has_device());
    RealClock clock;
    hand.start(clock);
    hand.tick(Instant(0));
    hand.end();
    hand.follow();
    EXPECT_EQ(hand.report().ticks, 0u);
    EXPECT_EQ(hand.name(), "none");
    EXPECT_EQ(hand.grant_news(), std::nullopt);
}

/// From now on this thread, and those it starts, may not ask for a real-time priority.
void give_up_priority() {
    rlimit none{};
    getrlimit(RLIMIT_RTPRIO, &none);
    none.rlim_cur = 0;
    setrlimit(RLIMIT_RTPRIO, &none);
    __user_cap_header_struct head{_LINUX_CAPABILITY_VERSION_3, 0};
    __user_cap_data_struct data[2]{};
    ASSERT_EQ(syscall(SYS_capget, &head, data), 0);
    for (auto* held : {&data[0].effective, &data[0].permitted, &data[0].inheritable})
        *held &= ~(1U << CAP_SYS_NICE);
    ASSERT_EQ(syscall(SYS_capset, &head, data), 0);
}

TEST(HandSide, SaysWhileItRunsThatItWasRefusedRealTime) {
    std::thread([] {  // a thread of its own: what it gives up does not come back
        give_up_priority();
        auto device = std::make_unique<NiceMock<MockHapticDevice>>();
        ON_CALL(*device, describe()).WillByDefault(Return("mock"));
        RealClock clock;
        HandSide hand(std::move(device), "mock", {}, {});
        EXPECT_EQ(hand.grant_news(), std::nullopt) << "it does not run yet";
        hand.start(clock);
        std::optional<std::string> news;
        for (int i = 0; i < 500 && !news; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            news = hand.grant_news();
        }
        EXPECT_THAT(
            news.value_or("nothing"),
            testing::StartsWith("the haptic thread has no real-time priority (Operation not permitted)"));
        EXPECT_EQ(hand.grant_news(), std::nullopt) << "once";
    })
        .join();
}

TEST(HandSide, SendsZeroLastWhenItIsDestroyed) {
    auto device = std::make_unique<NiceMock<MockHapticDevice>>();
    glm::dvec3 last_n(1.0);
    ON_CALL(*device, command(_)).WillByDefault([&](const glm::dvec3& force_n) { last_n = force_n; });
    ON_CALL(*device, describe()).WillByDefault(Return("mock"));
    EXPECT_CALL(*device, command(_)).Times(AtLeast(kClosingTicks));
    RealClock clock;
    {
        HandSide hand(std::move(device), "mock", {}, {});
        hand.start(clock);
    }
    EXPECT_EQ(last_n, glm::dvec3(0.0));
}

TEST(HandSide, HandsOutEveryTickOnceAndInOrder) {
    auto device = std::make_unique<NiceMock<MockHapticDevice>>();
    ON_CALL(*device, describe()).WillByDefault(Return("mock, homing"));
    HandSide hand(std::move(device), "mock", {}, {});
    std::vector<Instant> times;
    const auto each = [&](std::span<const TickRecord> part) {
        for (const TickRecord& tick : part) times.push_back(tick.t);
    };
    for (int n = 0; n < 10; ++n) hand.tick(n * kTick);
    hand.follow(each);
    for (int n = 10; n < 5000; ++n) hand.tick(n * kTick);
    hand.follow(each);
    ASSERT_EQ(times.size(), 5000u);
    for (std::size_t n = 0; n < times.size(); ++n) EXPECT_EQ(times[n], static_cast<int>(n) * kTick);
    EXPECT_EQ(hand.report().ticks, 5000u);
    hand.end();
    EXPECT_EQ(hand.name(), "mock, homing") << "as the device says once only this thread asks";
}

}  // namespace
}  // namespace eddy
