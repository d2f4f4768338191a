#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "hal/clock.h"

namespace eddy {

/// How much of its model's force a hand is given, so that moving it costs the work that a drag would do, and no more. The
/// acceleration is known some 60 ms late (motion_tracker.h), and an added mass that is late is a drag: a hand that stirs
/// twice a second would pay half as much again, five times a second nearly twice. So books are kept of the last quarter second: of the
/// work of model drag and model mass on the path that the hand really took, and of what a drag takes on that path,
/// the integral of b w^2. Where the sum is more, the drag is given up to make room, and the mass if that is not enough: a late mass
/// without any drag would be nothing but a drag.
class EnergyMatch {
  public:
    struct Shares {
        double drag = 1.0, added = 1.0;  ///< 0 .. 1
    };
    /// What a movement may cost beyond its drag: a fifth or a third more is the least that is felt (Jones,
    /// Hunter and Lafontaine 1997).
    static constexpr double kAllowed = 1.05;
    static constexpr Seconds kMemory{0.25};

    /// A tick: where the body is, and what the tracker said of it until now.
    void moved_to(const glm::dvec3& position_m, const glm::dvec3& velocity_m_s,
                  const glm::dvec3& acceleration_m_s2, Seconds dt);
    /// The shares move towards what the books say of these slopes.
    Shares follow(double drag_ns_m, double added_kg, Seconds dt);
    /// The next position starts anew; the shares stay.
    void forget();
    /// Its bytes are a state that it can be in (sound.h).
    bool is_sound() const;

  private:
    std::optional<glm::dvec3> position_m_;  ///< of the last tick
    /// Sums over that time, each less by the time that has passed since [m2/s, m2/s2].
    double tracked_drag_ = 0.0;   ///< of tracked velocity times way: what a model drag of 1 N s/m took
    double tracked_added_ = 0.0;  ///< of tracked acceleration times way: what a model mass of 1 kg took
    double true_drag_ = 0.0;      ///< of velocity squared: what a drag of 1 N s/m would have taken
    double true_added_ = 0.0;  ///< of velocity times acceleration: the kinetic energy of 1 kg, won and lost
    double began_ = 0.0;       ///< the kinetic energy of 1 kg with which the books began, fading as they do
    /// Velocities are those of chords: long enough that the steps of encoders are nothing to them.
    glm::dvec3 chord_from_m_{0.0};
    Seconds chord_{0.0};
    Shares shares_;
};

}  // namespace eddy
