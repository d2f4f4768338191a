#pragma once
#include <optional>

#include "firmware/haptic/exchange.h"
#include "hal/clock.h"

namespace eddy {

/// What the exhibit asks of the haptic loop: where the hand may go and at what gain; and that a force that was latched comes back
/// by itself, brought in gently, once its cause has been gone for a while.
class HandOrders {
  public:
    static constexpr Instant kLatchRest = std::chrono::seconds(3);

    explicit HandOrders(HapticExchange& exchange) : exchange_(exchange) {}

    /// From now on; but for the counts of resets and restarts, which are kept here.
    void give(const HapticOrders& orders);
    /// The exhibit's own word, over whatever a scene orders: whether there may be a force at all, and the most of it.
    void allow(bool force);
    void set_ceiling(double most_n);
    /// With each report: the cause of a latch, if it has been gone for so long that the latch may be released.
    std::optional<GateReason> cause_gone(Instant now, const LoopReport& report);
    void release_latch();
    /// As after a stop that nobody has ended: no force until restart().
    void stay_stopped();
    /// After a stop: there is a force again, if the stop input is not pressed.
    void restart();

  private:
    void publish();

    HapticExchange& exchange_;
    HapticOrders orders_;  ///< as they were given
    bool allowed_ = true, stopped_ = false;
    double ceiling_n_ = kDeviceMaxForceN;
    Instant latched_since_{0};
};

}  // namespace eddy
