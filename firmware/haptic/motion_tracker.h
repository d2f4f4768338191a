#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "hal/clock.h"

namespace eddy {

/// Velocity and acceleration from a series of positions that come in steps of an encoder count. A g-h-k filter with three equal
/// poles (E. Brookner, Tracking and Kalman Filtering Made Easy, 1998: "fading memory"): it follows a steady acceleration
/// without any lag, and rounds off what is quicker than kTrackerHz.
class MotionTracker {
  public:
    /// -3 dB of the acceleration; the three poles lie at 1 / 0.51 of that. Lower is smoother and later: as eddy haptics --quick
    /// has it, encoder counts make the force on a stirring hand tremble by 0.45 % and it is 12 ms late; at 6 Hz 1.0 %, 6 ms.
    static constexpr double kTrackerHz = 4.0;

    /// The position at a time; one that is not later than the last changes nothing. After a gap of more than 50 ms it starts
    /// anew, at rest.
    void take(const glm::dvec3& position_m, Instant at);
    /// The next position starts anew.
    void forget();

    const glm::dvec3& velocity_m_s() const { return velocity_m_s_; }
    const glm::dvec3& acceleration_m_s2() const { return acceleration_m_s2_; }

  private:
    std::optional<Instant> at_;
    glm::dvec3 position_m_{0.0}, velocity_m_s_{0.0}, acceleration_m_s2_{0.0};
};

}  // namespace eddy
