#include "firmware/hand_orders.h"

#include <algorithm>

namespace eddy {

void HandOrders::give(const HapticOrders& orders) {
    const HapticOrders kept = orders_;
    orders_ = orders;
    orders_.resets = kept.resets;
    orders_.restarts = kept.restarts;
    publish();
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

void HandOrders::publish() {
    HapticOrders orders = orders_;
    orders.enabled = orders.enabled && allowed_;
    orders.stop = orders.stop || stopped_;
    orders.most_n = std::min(orders.most_n, ceiling_n_);
    exchange_.orders.publish(orders);
}

void HandOrders::allow(bool force) {
    if (force == allowed_) return;
    allowed_ = force;
    publish();
}

void HandOrders::set_ceiling(double most_n) {
    ceiling_n_ = most_n;
    publish();
}

void HandOrders::release_latch() {
    ++orders_.resets;
    publish();
}

void HandOrders::stay_stopped() {
    stopped_ = true;
    publish();
}

void HandOrders::restart() {
    stopped_ = false;
    ++orders_.restarts;
    publish();
}

}  // namespace eddy
