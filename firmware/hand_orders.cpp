#include "firmware/hand_orders.h"

namespace eddy {

void HandOrders::give(const HapticOrders& orders) {
    const HapticOrders kept = orders_;
    orders_ = orders;
    orders_.resets = kept.resets;
    orders_.stop = kept.stop;
    orders_.restarts = kept.restarts;
    exchange_.orders.publish(orders_);
}

std::optional<GateReason> HandOrders::cause_gone(Instant now, const LoopReport& report) {
    const GateReason reason = report.reason;
    const bool latched = reason == GateReason::DeviceSilent || reason == GateReason::NotFinite;
    if (!latched || report.device != HapticState::Ready) {
        latched_since_ = now;
        return std::nullopt;
    }
    if (now - latched_since_ < kLatchRest) return std::nullopt;
    latched_since_ = now;
    return reason;
}

void HandOrders::release_latch() {
    ++orders_.resets;
    exchange_.orders.publish(orders_);
}

void HandOrders::stop(bool pressed) {
    orders_.stop = pressed;
    exchange_.orders.publish(orders_);
}

void HandOrders::restart() {
    ++orders_.restarts;
    exchange_.orders.publish(orders_);
}

}  // namespace eddy
