#pragma once
#include <algorithm>
#include <optional>

#include "firmware/haptic/exchange.h"

namespace eddy {

/// Where the hand is when the fluid is updated, which falls between two ticks of the loop. A path that is a millisecond short or
/// long is, at 75 updates a second, a velocity that is wrong by 7 % now and by -7 % next time: half of the acceleration of a
/// hand that stirs. So the pose is taken on to the update's own time, as fast as the hand came since the last update; the
/// velocity of a tick would bring the flicker of the encoders with it.
class HandPath {
  public:
    /// Metres, Tank frame. `now`: the end of the update. A pose that is further from the last than a hand of `fastest_m_s`
    /// goes is taken as it is. A hand that runs into a bound may be a tick's way beyond it, once.
    glm::dvec3 at(const PoseSnapshot& pose, Instant now, double fastest_m_s) {
        glm::dvec3 position_m = pose.position_m;
        if (last_ && pose.known && pose.time > last_->time) {
            const glm::dvec3 velocity_m_s =
                (pose.position_m - last_->position_m) / Seconds(pose.time - last_->time).count();
            const double age_s = std::clamp(Seconds(now - pose.time), Seconds(0.0), kFurthest).count();
            if (glm::length(velocity_m_s) <= fastest_m_s) position_m += age_s * velocity_m_s;
        }
        last_ = pose.known ? std::optional(pose) : std::nullopt;
        return position_m;
    }
    /// The next pose is the first.
    void forget() { last_.reset(); }

  private:
    /// Further than this the loop is held up, and where the hand went is not known.
    static constexpr Seconds kFurthest{0.002};

    std::optional<PoseSnapshot> last_;
};

}  // namespace eddy
