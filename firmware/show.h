#pragma once
#include <map>
#include <memory>
#include <optional>

#include "config/scene.h"
#include "firmware/body_schedule.h"
#include "firmware/force_ripple.h"
#include "firmware/gain_limit.h"
#include "firmware/haptic/exchange.h"
#include "firmware/haptic/hand_path.h"
#include "firmware/quality/force_handover.h"
#include "firmware/quality/quality.h"
#include "firmware/update_answer.h"
#include "gles/body/bounds.h"
#include "gles/fluid/fluid.h"

namespace eddy {

/// Ranges over the run, for the summary and the status page.
struct ShowFigures {
    long steps = 0;
    double fluid_period_s = 0.0;  ///< smoothed time between fluid updates
    std::optional<double>
        least_force_n{};  ///< of |raw force| on the hand, after gain; none: it got no answer
    double most_force_n = 0.0;
    double divergence_before_1_s = 0.0;  ///< of the last step that was diagnosed
    double divergence_after_1_s = 0.0;
    std::optional<double> fluid_speed_m_s{};  ///< rms over the tank, of that step
    long rested = 0;                          ///< updates left out because nothing moved
    long placed = 0;     ///< updates in which the hand's body was put where the hand is, not moved there
    long sub_steps = 0;  ///< steps taken beyond one for each update, to make up for a stall
    double fastest_m_s = 0.0;  ///< of the fluid, as the last step found it
};

/// The fluid side of the exhibit: takes the newest pose of the hand, moves the fluid on, gives the force
/// back. GL thread only; talks to the haptic loop through the exchange alone.
class Show {
  public:
    Show(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange);
    /// Begins with another quality than the scene's own.
    Show(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange, const Quality& quality);

    /// Makes fluids of these qualities, takes a step with each, lets neighbours take over from each other, and goes back to the
    /// start: drivers compile a shader when it is first drawn with, which takes seconds on some and must not fall into the
    /// show. Before the show only.
    void warm_up(const std::vector<Quality>& qualities);
    /// How steeply the fluid answers the hand. Before the show only: goes back to the start.
    FluidSlopes slopes();
    /// The same for one quality, during the show. Its fluid.
    const gles::Fluid& make_ready(const Quality& quality);
    bool is_ready(const Quality& quality) const { return fluids_.contains(quality); }
    /// From now on the fluid is computed so, from where it is; the force goes over to it without a jump. Quick only if
    /// it is ready.
    void set_quality(const Quality& quality);
    const Quality& quality() const { return quality_; }
    /// The time that a step covers by habit: the scene's, or as much as the machine needs.
    Seconds usual_step() const;
    /// In place of an update, while nothing moves: the last force stays the answer.
    void rest(Instant now);
    /// One fluid update of dt ending at `now`; `diagnose` also measures the whole tank. After a stall, several steps, along which
    /// the hand's body goes evenly from where it was.
    void update(Instant now, Seconds dt, bool diagnose);
    /// Hands results that the GPU has finished to the haptic loop; with `wait`, the oldest in any case.
    void publish(bool wait);

    /// Goes on counting answers and energy where this show ended: the haptic loop goes on too. Before the first update.
    void follow(const Show& before);
    /// Given to the haptic loop so far.
    std::uint64_t answers() const { return answer_.sequence; }
    /// The newest pose of the hand.
    const PoseSnapshot& pose() { return exchange_.pose.newest(); }
    /// What the hand gets of the force, for the figures: at first the scene's own.
    void set_gain(double gain) { gain_ = gain; }

    /// Fluid and prescribed bodies back to their start; what was under way is forgotten.
    void reset();

    const gles::Fluid& fluid() const { return *fluid_; }
    const std::vector<gles::BodyState>& bodies() const { return states_; }
    const ShowFigures& figures() const { return figures_; }
    /// What the guards did in all fluids of this show.
    gles::GuardCounts guards() const;
    /// How the force on the hand trembles, after gain [N]; worked out when asked.
    std::optional<ForceRipple::Figures> ripple() const { return ripple_.figures(); }

  private:
    gles::Fluid& made(const Quality& quality);
    void take_a_step(gles::Fluid& fluid) const;
    /// How many steps make up for dt.
    int parts_of(Seconds dt) const;

    gles::Gpu& gpu_;
    Scene scene_;
    HapticExchange& exchange_;
    BodySchedule motions_;
    Quality quality_;
    std::map<Quality, std::unique_ptr<gles::Fluid>>
        fluids_;          ///< all that were asked for: going back is quick
    gles::Fluid* fluid_;  ///< of quality_
    ForceHandover handover_;
    gles::Extent room_;  ///< where the hand's body may be
    std::vector<gles::BodyState> states_;
    double gain_;
    double time_s_ = 0.0;  // of the fluid; falls behind the clock when steps are too slow and dt is capped
    Instant last_{0};
    bool hand_known_ = false;  // the device gave a position for the last step
    HandPath path_;
    FluidSnapshot answer_;     // the last given to the haptic loop
    double stored_j_ = 0.0;    ///< kinetic energy of the fluid, of the last step that was diagnosed
    double received_j_ = 0.0;  ///< by the fluid from the held body
    /// A step under way, and how the held body went in it.
    struct UnderWay {
        bool answers = false;  ///< the last step of an update
        Instant pose_time{0};  ///< of the pose it was given
        double dt_s = 0.0;
        glm::dvec3 velocity_m_s{0.0}, before_m_s{0.0};  ///< in this step, and in the one before
    };
    std::map<long, UnderWay> under_way_;  ///< by the step's number
    glm::dvec3 held_velocity_m_s_{0.0};   ///< in the last step
    UpdateAnswer update_;                 ///< of the steps that were done of the update under way
    ShowFigures figures_;
    ForceRipple ripple_;
};

/// What the haptic loop is told for this scene: where the hand's workspace lies, how far the body may go, the
/// gain.
HapticOrders orders_for(const Scene& scene, const gles::FluidSetup& fluid);

}  // namespace eddy
