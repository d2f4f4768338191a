#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "hal/clock.h"
#include "hal/haptic/falcon/kinematics.h"
#include "hal/haptic/falcon/protocol.h"

namespace eddy::falcon {

/// Follows the handle from reply to reply, and refuses what cannot be true.
class Tracker {
  public:
    enum class Outcome { Followed, Implausible, Unsolved };

    /// Implausible: faster than a hand moves; believed in the end if it stays. Unsolved: no pose of the
    /// handle has these counts. Only Followed changes the position.
    Outcome take(const Axes& encoders, Instant at);
    /// The next reply starts afresh; until then there is no pose.
    void forget();

    /// Where the handle was last [m, Device].
    const glm::dvec3& position_m() const { return position_m_; }
    /// The legs there, for turning a force into torques; nothing if that was too long ago to push anybody.
    std::optional<Legs> legs(Instant now) const;

  private:
    bool plausible(const Axes& encoders, Instant at) const;

    ForwardKinematics kinematics_;
    std::optional<Axes> encoders_;  // last believed
    Instant encoders_at_{0};
    glm::dvec3 position_m_{0.0};
    std::optional<Legs> legs_;
    Instant legs_at_{0};
};

}  // namespace eddy::falcon
