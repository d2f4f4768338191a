#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "hal/clock.h"

namespace eddy {

/// Velocity and acceleration from a series of positions that come in steps of an encoder count. A g-h-k filter with three equal
/// poles (E. Brookner, Tracking and Kalman Filtering Made Easy, 1998: "fading memory"): it follows a steady acceleration
/// without any lag, and rounds off what is quicker than its poles. They are slow while the hand is where it was expected, and
/// quicker the further it is from there: who stirs gets a smooth force, who sets off an early one.
class MotionTracker {
  public:
    /// Slower is smoother and later: as eddy haptics --quick has it, encoder counts make the force on a stirring hand tremble by
    /// 0.30 % with 40, 0.38 % with 45, and half of the force of a hand that sets off is there after 10 ms.
    static constexpr double kCalm_1_s = 40.0, kQuick_1_s = 70.0;
    /// Metres of the handle. A circle of 20 mm a second is missed by 0.08 mm (the radius times the cube of its frequency over
    /// the pole), a count is 0.06 mm; a hand that sets off at 0.1 m/s is missed by 1 mm after 10 ms.
    static constexpr double kExpectedM = 0.15e-3, kMissedM = 0.65e-3;

    /// The position at a time; one that is not later than the last changes nothing. After a gap of more than 50 ms it starts
    /// anew, at rest.
    void take(const glm::dvec3& position_m, Instant at);
    /// The next position starts anew.
    void forget();

    /// Where it most likely is, between the steps of the encoders; never further than kExpectedM from `position_m`, the newest.
    glm::dvec3 near(const glm::dvec3& position_m) const;
    const glm::dvec3& velocity_m_s() const { return velocity_m_s_; }
    const glm::dvec3& acceleration_m_s2() const { return acceleration_m_s2_; }
    /// Its bytes are a state that it can be in (sound.h).
    bool is_sound() const;

  private:
    std::optional<Instant> at_;
    glm::dvec3 position_m_{0.0}, velocity_m_s_{0.0}, acceleration_m_s2_{0.0};
};

}  // namespace eddy
