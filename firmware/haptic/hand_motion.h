#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "hal/haptic/haptic_device.h"

namespace eddy {

/// Cut-off of the velocity estimate. One encoder count (63.5 um, Falcon spec sheet: 400 dpi) in one tick is
/// 0.06 m/s; 40 Hz makes that 0.014 m/s. The price is kVelocityDelay on the velocity, small beside a fluid
/// step.
inline constexpr double kVelocityCutoffHz = 40.0;
/// Lag of the estimate behind a steady acceleration at 1 kHz: half a tick for the difference, 3.5 ms for the
/// low-pass.
inline constexpr Seconds kVelocityDelay{0.004};

/// Where the handle is and how fast it moves: the newest reading, and the low-passed backward difference of
/// the readings.
class HandMotion {
  public:
    /// A reading older than the last one, or of the same instant, moves the position and leaves the velocity.
    /// False, and nothing taken, if the position or the velocity it leads to is not finite.
    bool take(const HandleReading& reading);
    /// Stands still from now on; the next reading starts afresh. For a device that was away and may have
    /// moved.
    void forget();

    const glm::dvec3& position_m() const {
        return position_m_;
    }  ///< Device frame; the origin before any reading
    const glm::dvec3& velocity_m_s() const { return velocity_m_s_; }  ///< Device frame
    /// Its bytes are a state that it can be in (sound.h).
    bool is_sound() const;

  private:
    glm::dvec3 position_m_{0.0};
    glm::dvec3 velocity_m_s_{0.0};
    std::optional<Instant> taken_at_;
};

}  // namespace eddy
