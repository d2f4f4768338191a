#pragma once
#include <deque>
#include <optional>
#include <string>

#include "firmware/stability/fields.h"

namespace eddy::stability {

// The one rule by which a hard case passes. It looks at what the solver left in its textures and at what the hand was
// given. What the solver says of itself is never an excuse; that it found fault with itself between two looks is one more.
// Its terms:
//   finite   no texel of velocity, pressure, smoke or temperature, no force and no torque is nan or infinite
//   speed    max |u| <= 5 times the fastest thing that moves the fluid: a body, jet, wall, or buoyancy, as sqrt(g' L);
//            times how much a gap narrows the flow, where continuity makes it faster
//   energy   kinetic energy <= that at any time more than a second ago + the work done on the fluid since + what it was given
//            ahead of the work + 5 % of what it was ever given: what friction has taken is gone
//   range    smoke and temperature stay between what they were at the start, with 0, and what sources have added
//   force    what the hand gets is never above its limit, and rises no faster than the slew limit; falling to zero may
//            be at once (firmware/haptic/force_gate.h)
//   calm     5 s after the last disturbance the force is below 2 % of its peak, and kinetic energy is down to half
//            after 5 s or the time L^2 / (pi^2 nu) of friction, whichever is longer

inline constexpr double kSpeedFactor = 5.0;
inline constexpr double kEnergyMargin = 0.05;
/// Within it, books of steps as coarse as a motion do not balance.
inline constexpr double kEnergyMemoryS = 1.0;
inline constexpr double kRangeMargin = 1e-3;  ///< of the range: rounding
inline constexpr double kCalmS = 5.0;
inline constexpr double kCalmForce = 0.02;
/// At rest rounding moves the fluid by 3e-7 sqrt(g L) (case A7 of eddy accuracy); a hundred times that is still rest.
inline constexpr double kRestShare = 3e-5;

/// What may be in the tank by now (ledger.h keeps the books).
struct Justified {
    double speed_m_s = 0.0;  ///< of the fastest that has moved the fluid
    double narrowing = 1.0;  ///< times as fast in the narrowest gap
    double work_j = 0.0;     ///< done on the fluid since the start, less what it gave back
    double given_j = 0.0;    ///< the same without what it gave back
    double ahead_j = 0.0;    ///< of work_j, what may still be done at any time
    FieldRange smoke_added = {};
    FieldRange temperature_added_k = {};
    double rest_speed_m_s = 0.0;  ///< sqrt(g L) of gravity: what the rounding of weights is measured by
};

/// A step.
struct StepSeen {
    long step = 0;
    double time_s = 0.0;  ///< at its end
    Justified justified = {};
    const Fields* fields = nullptr;  ///< null: nobody has looked
    /// On the bodies, without what they feel in fluid at rest.
    std::vector<gles::Load> loads = {};
    bool disturbed = true;  ///< something acts on the fluid from outside
    /// A fault was put into the fluid so few steps ago that it may still be there: it is counted, not judged.
    bool pardoned = false;
};

/// What the hand may get.
struct HandLimits {
    double most_n = 8.0;
    double slew_n_per_s = 100.0;
};

struct Verdict {
    bool pass = true;
    std::string reason = {};                ///< the first thing that was wrong, in words
    double kinetic_energy_ratio = 0.0;      ///< largest, to what the energy term allows
    double largest_force_n = 0.0;           ///< on any body, before gain
    std::optional<double> recovery_s = {};  ///< from the last disturbance to calm
    long non_finite = 0;                    ///< most texels at a time, and loads that were not finite
};

class Rule {
  public:
    Rule(const Tank& tank, const HandLimits& hand = {});

    /// What the tank starts with.
    void begin(const Fields& fields);
    void see(const StepSeen& step);
    /// What the hand gets at a tick that comes dt_s after the last.
    void feel(const glm::dvec3& force_n, double dt_s);
    /// Something else than the rule found fault: a case's own criterion.
    void blame(long step, const std::string& reason);
    /// When all is over.
    Verdict verdict() const;
    bool failed() const { return !verdict_.pass; }

  private:
    void fail(std::string reason);
    void judge(const StepSeen& step);
    void see_loads(const StepSeen& step);
    void see_calm(const StepSeen& step);

    Tank tank_;
    HandLimits hand_;
    Verdict verdict_;
    double start_energy_j_ = 0.0, start_speed_m_s_ = 0.0;
    /// Kinetic energy less the work done until then: of the last second, and at its lowest before.
    struct Unexplained {
        double time_s, energy_j;
    };
    std::deque<Unexplained> lately_;
    double least_j_ = 0.0;
    FieldRange start_smoke_, start_temperature_k_;
    glm::dvec3 felt_n_{0.0};
    double felt_s_ = 0.0;  ///< how long the hand has felt
    // of the calm after the last disturbance
    double peak_force_n_ = 0.0, force_n_ = 0.0;
    double energy_j_ = 0.0, calm_energy_j_ = 0.0, calm_since_s_ = 0.0, time_s_ = 0.0;
    std::optional<double> force_calm_s_, energy_calm_s_;
    bool calm_ = false;
};

}  // namespace eddy::stability
