#pragma once
#include "firmware/haptic/law.h"
#include "firmware/stability/history.h"
#include "firmware/stability/rule.h"

namespace eddy::stability {

/// The hand and its 1 kHz loop, on virtual time: the law and its gate are the exhibit's, the handle goes where it is told.
class Hand {
  public:
    Hand(const HapticOrders& orders, const GateLimits& limits);

    /// Ticks until `interval_s` later; the handle moves steadily to where it shows `target_m` in the tank.
    void tick(double interval_s, const glm::dvec3& target_m, const FluidSnapshot& fluid, bool answered,
              Rule& rule, History& history);
    const PoseSnapshot& pose() const { return pose_; }
    Instant now() const { return now_; }

  private:
    HapticOrders orders_;
    LawState state_;
    PoseSnapshot pose_{};
    Instant now_{0};
    double owed_s_ = 0.0;  ///< of a tick that is not full yet
    glm::dvec3 at_m_{0.0};
    bool held_ = false;
};

}  // namespace eddy::stability
