#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "firmware/haptic/motion_tracker.h"
#include "firmware/haptic/stability_limits.h"
#include "hal/clock.h"

namespace eddy {

/// What damps a handle by a velocity that is tracked, drag of the model and damping together, may be no more than this, or it drives
/// the handle that it should hold. The tracker's velocity is p^2 (3 s + p) / (s + p)^3 of the true one (three poles p,
/// motion_tracker.h), so a handle of mass m under a damper B goes m s (s + p)^3 + B p^2 (3 s + p) = 0. By Routh's
/// criterion that dies away while 9 b^2 - 12 b - 8 < 0, b = B / (m p): while B < 1.82 m p, 10.9 N s/m with the calm poles, and
/// swings at 1.47 p, 9 Hz, beyond. The 1.5 ms of encoders, exchange and hold take 5 % of that, an added mass of m / 2 another 5 %;
/// half of it is used.
inline constexpr double kMostTrackedNsM = kStabilityShare * 1.82 * kHandleMassKg * MotionTracker::kCalm_1_s;

/// The passivity observer and controller of Hannaford and Ryu (IEEE Trans. Robotics and Automation 18, 2002), for all that lies
/// between the fluid and the hand: the frame of delay, the hold, the filter, the local model. On the one side the fluid
/// keeps books of the work it did on its body: whatever it gives, out of a jet or of flow that was stirred before, stands there.
/// On the other side is what the hand did against the force it was given. All between may take energy but has none of its own to
/// give: where the hand did less than the fluid received, the difference is taken out by damping. But as long as there is
/// flow, its kinetic energy stands for a debt, as in their paper: the force of a stream that shifts comes to the hand a little
/// late, and that is no reason to brake it.
class Passivity {
  public:
    /// Differences up to this share of what passes are let pass: forces and paths are known no better.
    static constexpr double kTolerated = 0.05;
    /// What was taken in excess is remembered as a claim on what may be given in excess later; no more than so much [J]: a gentle
    /// movement of the handle holds as much.
    static constexpr double kReserveJ = 0.5e-3;
    /// A debt is paid back over this time, not in one tick as in the paper: that would be a tap.
    static constexpr Seconds kPayBack{0.030};

    /// A velocity below this is hardly more than the flicker of an encoder, and no energy: damping fades out.
    static constexpr double kStillMS = 0.02;

    /// A tick: where the handle is, before the tick's force is given.
    void moved_to(const glm::dvec3& position_m, Instant now);
    /// The fluid's answer to the pose of that time: what it has received from its body since the last answer, and what energy it
    /// has now [J of the hand].
    void received(double received_j, double stored_j, Instant pose_time);
    /// The damping force for this tick, at this velocity on the way that moved_to() counts: against a wall the handle flickers
    /// and the body stands still, and damping that flicker pays no debt back. `drag_ns_m`: what else is given against that
    /// velocity.
    glm::dvec3 damping_n(const glm::dvec3& velocity_m_s, double drag_ns_m) const;
    /// The whole force that is given until the next tick, and how much of it is damping.
    void given(const glm::dvec3& force_n, const glm::dvec3& damping_n);
    /// The force does not come from the fluid, or not as a whole: the books begin anew.
    void begin_anew();

    double energy_j() const { return balance_j_ + paid_since_j(); }  ///< below 0: a debt
    double least_j() const { return least_j_; }                      ///< since start
    std::uint64_t damped() const { return damped_; }                 ///< ticks
    /// Its bytes are a state that it can be in (sound.h).
    bool is_sound() const;

  private:
    /// What the hand has done, and what of it against the damping, up to a tick.
    struct Entry {
        Instant at{0};
        double hand_j = 0.0;
        double damping_j = 0.0;
    };
    /// Half a second of ticks: an answer later than that is compared with the oldest of them.
    static constexpr std::size_t kKept = 512;

    double paid_since_j() const { return now_.damping_j - settled_.damping_j; }

    std::array<Entry, kKept> past_{};
    std::size_t next_ = 0;
    Entry now_{};      ///< the last tick
    Entry settled_{};  ///< the tick of the last answer's pose: up to there the two sides were compared
    bool running_ = false, answered_ = false;
    glm::dvec3 position_m_{0.0}, force_n_{0.0}, damping_n_{0.0};
    double balance_j_ = 0.0, stored_j_ = 0.0, least_j_ = 0.0;
    std::uint64_t damped_ = 0;
};

}  // namespace eddy
