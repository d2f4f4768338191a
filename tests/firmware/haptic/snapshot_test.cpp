#include "firmware/haptic/snapshot.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace eddy {
namespace {

TEST(Snapshot, IsAValueInitialisedObjectBeforeTheFirstPublish) {
    Snapshot<std::array<int, 4>> snapshot;
    EXPECT_EQ(snapshot.newest(), (std::array<int, 4>{}));
}

TEST(Snapshot, TheNewestWinsAndStays) {
    Snapshot<int> snapshot;
    for (int i = 1; i <= 7; ++i) snapshot.publish(i);
    EXPECT_EQ(snapshot.newest(), 7);
    EXPECT_EQ(snapshot.newest(), 7);
    snapshot.publish(8);
    EXPECT_EQ(snapshot.newest(), 8);
}

TEST(Snapshot, TheValueReadIsNotTouchedByLaterPublishes) {
    Snapshot<int> snapshot;
    snapshot.publish(1);
    const int& held = snapshot.newest();
    for (int i = 2; i < 10; ++i) snapshot.publish(i);
    EXPECT_EQ(held, 1);
}

// Every field of a value carries its sequence number: a torn value shows as two numbers, a stale one as a
// step back.
TEST(Snapshot, IsNeverTornAndNeverGoesBackBetweenThreads) {
    constexpr std::uint64_t kLast = 200'000;
    using Value = std::array<std::uint64_t, 24>;
    Snapshot<Value> snapshot;
    std::thread writer([&] {
        Value value;
        for (std::uint64_t i = 1; i <= kLast; ++i) {
            value.fill(i);
            snapshot.publish(value);
        }
    });
    std::uint64_t seen = 0, torn = 0, backwards = 0;
    while (seen < kLast) {
        const Value& value = snapshot.newest();
        for (const std::uint64_t field : value) torn += field != value.front();
        backwards += value.front() < seen;
        seen = value.front();
    }
    writer.join();
    EXPECT_EQ(torn, 0U);
    EXPECT_EQ(backwards, 0U);
}

}  // namespace
}  // namespace eddy
