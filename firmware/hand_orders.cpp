#include "firmware/hand_orders.h"

namespace eddy {

void HandOrders::give(const HapticOrders& orders) {
    const std::uint64_t resets = orders_.resets;
    orders_ = orders;
    orders_.resets = resets;
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

}  // namespace eddy
