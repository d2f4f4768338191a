#include "firmware/exhibit/opening_hours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/firmware/exhibit/time_zone.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

HoursConfig museum() {
    HoursConfig c;
    c.monday = "closed";
    c.tuesday = c.wednesday = c.thursday = c.friday = "09:00-12:00, 13:00-17:00";
    c.saturday = c.sunday = "10:00-18:00";
    c.exceptions = "2026-12-24 09:00-12:00; 2026-12-25 closed; 2026-11-23 20:00-24:00";
    return c;
}

// 2026-11-24 is a Tuesday; Berlin's winter time is an hour ahead.
TEST(OpeningHours, OpenAndCloseToTheSecond) {
    const TimeZone berlin(kBerlin);
    const OpeningHours hours(museum());
    EXPECT_FALSE(hours.is_open(utc("2026-11-24 07:59:59Z")));
    EXPECT_TRUE(hours.is_open(utc("2026-11-24 08:00:00Z")));
    EXPECT_TRUE(hours.is_open(utc("2026-11-24 10:59:59Z")));
    EXPECT_FALSE(hours.is_open(utc("2026-11-24 11:00:00Z")));
    EXPECT_EQ(hours.next_change(utc("2026-11-24 11:00:30Z")), utc("2026-11-24 12:00:00Z"));
    EXPECT_EQ(hours.next_change(utc("2026-11-24 16:00:00Z")), utc("2026-11-25 08:00:00Z"));
}

TEST(OpeningHours, ExceptionsReplaceTheWeekday) {
    const TimeZone berlin(kBerlin);
    const OpeningHours hours(museum());
    EXPECT_FALSE(hours.is_open(utc("2026-12-24 13:00:00Z"))) << "a Thursday";
    EXPECT_FALSE(hours.is_open(utc("2026-12-25 10:00:00Z")));
    EXPECT_EQ(hours.next_change(utc("2026-12-24 12:00:00Z")), utc("2026-12-26 09:00:00Z"));
    EXPECT_TRUE(hours.is_open(utc("2026-11-23 22:59:59Z"))) << "a Monday, up to midnight";
    EXPECT_FALSE(hours.is_open(utc("2026-11-23 23:00:00Z")));
}

TEST(OpeningHours, AreThoseOfTheWallAlsoWhenClocksGoForward) {
    const TimeZone berlin(kBerlin);
    HoursConfig c;
    c.sunday = "02:30-04:00";
    c.saturday = "closed";
    const OpeningHours hours(c);
    // 2026-03-29: 01:59:59 is followed by 03:00:00, at 01:00 UTC.
    EXPECT_FALSE(hours.is_open(utc("2026-03-29 00:59:59Z")));
    EXPECT_TRUE(hours.is_open(utc("2026-03-29 01:00:00Z"))) << "half past two never comes: open from three";
    EXPECT_EQ(hours.next_change(utc("2026-03-29 00:10:00Z")), utc("2026-03-29 01:00:00Z"));
    EXPECT_EQ(hours.next_change(utc("2026-03-29 01:00:00Z")), utc("2026-03-29 02:00:00Z"));
}

TEST(OpeningHours, AreThoseOfTheWallAlsoWhenClocksGoBack) {
    const TimeZone berlin(kBerlin);
    HoursConfig c;
    c.sunday = "02:30-04:00";
    c.saturday = "closed";
    const OpeningHours hours(c);
    // 2026-10-25: 02:59:59 (00:59:59 UTC) is followed by 02:00:00.
    EXPECT_TRUE(hours.is_open(utc("2026-10-25 00:30:00Z")));
    EXPECT_EQ(hours.next_change(utc("2026-10-25 00:30:00Z")), utc("2026-10-25 01:00:00Z"));
    EXPECT_FALSE(hours.is_open(utc("2026-10-25 01:00:00Z"))) << "the wall says two again";
    EXPECT_EQ(hours.next_change(utc("2026-10-25 01:00:00Z")), utc("2026-10-25 01:30:00Z"));
    EXPECT_EQ(hours.next_change(utc("2026-10-25 01:30:00Z")), utc("2026-10-25 03:00:00Z"));
}

TEST(OpeningHours, NothingWrittenIsAlwaysOpen) {
    const OpeningHours hours{HoursConfig{}};
    EXPECT_TRUE(hours.is_open(0));
    EXPECT_EQ(hours.next_change(0), std::nullopt);
}

TEST(OpeningHours, AMuseumThatIsClosedForGoodHasNoNextChange) {
    HoursConfig c;
    c.monday = c.tuesday = c.wednesday = c.thursday = c.friday = c.saturday = c.sunday = "closed";
    const OpeningHours hours(c);
    EXPECT_FALSE(hours.is_open(utc("2026-11-24 08:00:00Z")));
    EXPECT_EQ(hours.next_change(utc("2026-11-24 08:00:00Z")), std::nullopt);
}

TEST(Opening, NeverClosesByAClockThatMayBeWrong) {
    const TimeZone berlin(kBerlin);
    Opening opening(museum());
    const std::time_t night = utc("2026-11-24 02:00:00Z");
    EXPECT_TRUE(opening.look(night, false).open);
    EXPECT_EQ(describe(opening.state()), "open: the clock is not synchronised");
    EXPECT_FALSE(opening.look(night, true).open) << "the clock was set, to the very same second";
    EXPECT_EQ(describe(opening.state()), "closed until Tuesday 09:00");
}

TEST(Opening, SaysOnceThatNobodyVouchesForTheClock) {
    const TimeZone berlin(kBerlin);
    Opening opening(museum());
    opening.look(utc("2026-11-24 02:00:00Z"), false);
    EXPECT_FALSE(opening.doubts(9min)) << "the network may yet come";
    EXPECT_TRUE(opening.doubts(11min));
    EXPECT_FALSE(opening.doubts(12min));

    Opening trusted(museum());
    trusted.look(utc("2026-11-24 02:00:00Z"), true);
    EXPECT_FALSE(trusted.doubts(11min));

    Opening always(HoursConfig{});
    always.look(utc("2026-11-24 02:00:00Z"), false);
    EXPECT_FALSE(always.doubts(11min)) << "nobody asks for the time";
}

TEST(Opening, ChangesToTheSecondAndSaysWhenNext) {
    const TimeZone berlin(kBerlin);
    Opening opening(museum());
    int changes = 0;
    bool open = opening.look(utc("2026-11-24 00:00:00Z"), true).open;
    for (std::time_t t = utc("2026-11-24 00:00:00Z"); t < utc("2026-11-24 23:00:00Z"); ++t) {
        const Opening::State state = opening.look(t, true);
        ASSERT_GT(state.next_change.value_or(0), t);
        if (state.open != open) ++changes;
        open = state.open;
    }
    EXPECT_EQ(changes, 4);
}

TEST(Opening, FollowsAClockThatIsSetBack) {
    const TimeZone berlin(kBerlin);
    Opening opening(museum());
    opening.look(utc("2026-11-24 20:00:00Z"), true);
    EXPECT_EQ(opening.look(utc("2026-11-24 09:00:00Z"), true).next_change, utc("2026-11-24 11:00:00Z"));
}

}  // namespace
}  // namespace eddy
