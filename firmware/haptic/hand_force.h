#pragma once
#include <optional>

#include "firmware/haptic/energy_match.h"
#include "firmware/haptic/exchange.h"
#include "firmware/haptic/force_filter.h"
#include "firmware/haptic/local_model.h"
#include "firmware/haptic/motion_tracker.h"
#include "firmware/haptic/passivity.h"

namespace eddy {

/// What a tick knows of the hand.
struct HandAtTick {
    Instant now{0};
    bool known = false;               ///< the device is ready and answering
    std::optional<Instant> moved_at;  ///< when the reading was taken, if one came in this tick
    glm::dvec3 body_m{0.0};           ///< where the body is shown, Tank frame
};

/// The fluid's answers made into a force for each tick, by one law or the other. With the model it is
///   gain (low-pass(F - model(v, a)) + model(v now, a now)) - damping v,
/// F the newest answer and v, a the motion of the body that it belongs to: as long as nothing is known of the slopes this is
/// the other law. Of the model now, as much as the work of its drag allows (energy_match.h).
class HandForce {
  public:
    HandForce() = default;
    HandForce(ForceLaw law, const ForceFilterSettings& filter) : law_(law), filter_(filter) {}

    /// Newtons on the hand, before walls and gate. `fresh`: this answer was not there in the last tick.
    glm::dvec3 operator()(const FluidSnapshot& fluid, bool fresh, const HapticOrders& orders,
                          const HandAtTick& hand, Seconds dt);
    /// Where the fluid is told that a body is which the encoders show at `body_m` (Tank frame): it differences places twice, and to
    /// it each step of an encoder would be a blow.
    glm::dvec3 between_counts(const glm::dvec3& body_m, double scale) const {
        return scale * hand_.near(body_m / scale);
    }
    /// After a tick whose force did not reach the hand.
    void interrupted() { passivity_.begin_anew(); }

    std::uint64_t impulses() const { return filter_.impulses(); }
    const ForceReport& report() const { return report_; }
    /// Its bytes are a state that it can be in (sound.h).
    bool is_sound() const;

  private:
    void hear(const FluidSnapshot& fluid, const SlopeBounds& bounds, double energy_at_handle);
    void follow(const HandAtTick& hand, double scale, Seconds dt);

    ForceLaw law_ = ForceLaw::Model;
    ForceFilter filter_{};
    LocalModel model_{};
    MotionTracker hand_{};  ///< the body's motion, as the handle makes it
    EnergyMatch match_{};
    Passivity passivity_{};
    glm::dvec3 rest_n_{0.0};   ///< what the model does not explain, rounded off
    double received_j_ = 0.0;  ///< as the last answer said
    ForceReport report_{};
};

}  // namespace eddy
