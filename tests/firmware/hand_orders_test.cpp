#include "firmware/hand_orders.h"

#include <gtest/gtest.h>

namespace eddy {
namespace {

using namespace std::chrono_literals;

LoopReport report_of(GateReason reason, HapticState device = HapticState::Ready) {
    LoopReport report;
    report.reason = reason;
    report.device = device;
    return report;
}

TEST(HandOrders, ReleaseALatchOnceItsCauseHasBeenGoneForThreeSeconds) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    for (const GateReason cause : {GateReason::NotFinite, GateReason::DeviceSilent}) {
        orders.cause_gone(10s, report_of(GateReason::Open));
        EXPECT_FALSE(orders.cause_gone(12999ms, report_of(cause)));
        EXPECT_EQ(orders.cause_gone(13s, report_of(cause)), cause);
        EXPECT_FALSE(orders.cause_gone(15999ms, report_of(cause))) << "and not again at once";
    }
}

TEST(HandOrders, DoNotReleaseALatchWhileTheDeviceIsAway) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    for (int second = 0; second < 60; ++second)
        EXPECT_FALSE(
            orders.cause_gone(second * 1s, report_of(GateReason::DeviceSilent, HapticState::Absent)));
    EXPECT_FALSE(orders.cause_gone(61s, report_of(GateReason::DeviceSilent)));
    EXPECT_TRUE(orders.cause_gone(62s, report_of(GateReason::DeviceSilent)));
}

TEST(HandOrders, LeaveTheGateAloneWhereNothingIsLatched) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    for (int second = 0; second < 60; ++second)
        for (const GateReason reason : {GateReason::Open, GateReason::Disabled})
            EXPECT_FALSE(orders.cause_gone(second * 1s, report_of(reason)));
}

TEST(HandOrders, GivenAnewKeepTheirCountOfResets) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    HapticOrders first;
    first.gain = 2.0;
    orders.give(first);
    orders.release_latch();
    orders.release_latch();
    EXPECT_EQ(exchange.orders.newest().resets, 2u);
    EXPECT_EQ(exchange.orders.newest().gain, 2.0);
    HapticOrders second;
    second.gain = 3.0;
    orders.give(second);
    EXPECT_EQ(exchange.orders.newest().resets, 2u) << "a lower count would be another reset";
    EXPECT_EQ(exchange.orders.newest().gain, 3.0);
}

TEST(HandOrders, GivenAnewForgetNoRestart) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    orders.restart();
    orders.give({.enabled = true});
    EXPECT_TRUE(exchange.orders.newest().enabled);
    EXPECT_EQ(exchange.orders.newest().restarts, 1u);
}

TEST(HandOrders, StayStoppedUntilARestart) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    orders.stay_stopped();
    EXPECT_TRUE(exchange.orders.newest().stop);
    orders.give({.enabled = true});
    EXPECT_TRUE(exchange.orders.newest().stop) << "whatever a scene orders";
    orders.restart();
    EXPECT_FALSE(exchange.orders.newest().stop);
    EXPECT_EQ(exchange.orders.newest().restarts, 1u);
}

TEST(HandOrders, NeverReleaseAStopByThemselves) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    for (int second = 0; second < 60; ++second)
        EXPECT_FALSE(orders.cause_gone(second * 1s, report_of(GateReason::Stopped)));
}

TEST(HandOrders, AllowNoMoreThanTheExhibitDoesWhateverASceneOrders) {
    HapticExchange exchange;
    HandOrders orders(exchange);
    HapticOrders scene;
    scene.enabled = true;
    scene.most_n = 3.0;
    orders.give(scene);
    EXPECT_EQ(exchange.orders.newest().most_n, 3.0);
    orders.set_ceiling(2.0);
    EXPECT_EQ(exchange.orders.newest().most_n, 2.0);
    orders.set_ceiling(4.0);
    EXPECT_EQ(exchange.orders.newest().most_n, 3.0);

    orders.allow(false);
    EXPECT_FALSE(exchange.orders.newest().enabled);
    orders.give(scene);
    EXPECT_FALSE(exchange.orders.newest().enabled) << "another scene does not open what is closed";
    orders.allow(true);
    EXPECT_TRUE(exchange.orders.newest().enabled);
}

}  // namespace
}  // namespace eddy
