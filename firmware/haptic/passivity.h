#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "hal/clock.h"

namespace eddy {

/// The most that may be injected; the Falcon's own controllers go no higher (CHAI3D, CDeltaDevices.cpp: 20 N s/m).
inline constexpr double kMostInjectedNsM = 20.0;

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
    /// and the body stands still, and damping that flicker pays no debt back.
    glm::dvec3 damping_n(const glm::dvec3& velocity_m_s) const;
    /// The whole force that is given until the next tick, and how much of it is damping.
    void given(const glm::dvec3& force_n, const glm::dvec3& damping_n);
    /// The force does not come from the fluid, or not as a whole: the books begin anew.
    void begin_anew();

    double energy_j() const { return balance_j_ + paid_since_j(); }  ///< below 0: a debt
    double least_j() const { return least_j_; }                      ///< since start
    std::uint64_t damped() const { return damped_; }                 ///< ticks

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
