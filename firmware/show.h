#pragma once
#include <map>
#include <memory>

#include "config/scene.h"
#include "firmware/body_schedule.h"
#include "firmware/force_ripple.h"
#include "firmware/haptic/exchange.h"
#include "gles/fluid/fluid.h"

namespace eddy {

/// Ranges over the run, for the summary and the status page.
struct ShowFigures {
    long steps = 0;
    double fluid_period_s = 0.0;                     ///< smoothed time between fluid updates
    double least_force_n = 0.0, most_force_n = 0.0;  ///< of |raw force| on the hand, after gain
    double divergence_before_1_s = 0.0;              ///< of the last step that was diagnosed
    double divergence_after_1_s = 0.0;
};

/// The fluid side of the exhibit: takes the newest pose of the hand, moves the fluid on, gives the force
/// back. GL thread only; talks to the haptic loop through the exchange alone.
class Show {
  public:
    Show(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange);

    /// Takes a step and goes back to the start: drivers compile a shader when it is first drawn with, which
    /// takes seconds on some and must not fall into the show.
    void warm_up();
    /// One fluid update of dt ending at `now`; `diagnose` also measures the whole tank.
    void update(Instant now, Seconds dt, bool diagnose);
    /// Hands results that the GPU has finished to the haptic loop; with `wait`, the oldest in any case.
    void publish(bool wait);

    /// Fluid and prescribed bodies back to their start; what was under way is forgotten.
    void reset();

    const gles::Fluid& fluid() const { return *fluid_; }
    const std::vector<gles::BodyState>& bodies() const { return states_; }
    const ShowFigures& figures() const { return figures_; }
    /// How the force on the hand trembles, after gain [N]; worked out when asked.
    std::optional<ForceRipple::Figures> ripple() const { return ripple_.figures(); }

  private:
    Scene scene_;
    HapticExchange& exchange_;
    BodySchedule motions_;
    std::unique_ptr<gles::Fluid> fluid_;
    std::vector<gles::BodyState> states_;
    double time_s_ = 0.0;  // of the fluid; falls behind the clock when steps are too slow and dt is capped
    Instant last_{0};
    bool hand_known_ = false;               // the device gave a position for the last step
    std::uint64_t sequence_ = 0;            // of the answers given to the haptic loop
    std::map<long, Instant> computed_for_;  // step under way -> time of the pose it was given
    ShowFigures figures_;
    ForceRipple ripple_;
};

/// What the haptic loop is told for this scene: where the hand's workspace lies, how far the body may go, the
/// gain.
HapticOrders orders_for(const Scene& scene, const gles::FluidSetup& fluid);

}  // namespace eddy
