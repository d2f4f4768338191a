#include "firmware/stability/rig.h"

#include "firmware/show.h"
#include "gles/fluid/step_guard.h"

namespace eddy::stability {
namespace {

/// The fluid alone, given whatever a case likes.
class Steps final : public Rig {
  public:
    Steps(gles::Gpu& gpu, const Scene& scene, const gles::FluidSetup& setup, ChangeBodies change,
          double stop_s)
        : fluid_(gles::make_fluid(gpu, setup)), motions_(scene), change_(std::move(change)), stop_s_(stop_s) {
        loads_.resize(scene.bodies.size());
    }

    void step(const Moment& moment, const PoseSnapshot&, Instant now) override {
        if (moment.flow) {
            std::vector<glm::vec3> u = fluid_->velocity();
            moment.flow(u);
            fluid_->set_velocity(u);
        }
        const double passes_s = taken_s(fluid_->setup(), moment.dt_s);
        const double before_s = std::exchange(time_s_, time_s_ + passes_s);
        std::vector<gles::BodyState> bodies =
            bodies_at(before_s, passes_s > 0.0 ? passes_s : moment.scene->solver.dt_s);
        if (const auto held = motions_.held()) {
            gles::BodyState& body = bodies[*held];
            body.centre_m = moment.hand_m;
            if (passes_s > 0.0) {  // else it stays where it was
                body.velocity_m_s = at_m_ ? (moment.hand_m - *at_m_) / passes_s : glm::dvec3(0.0);
                at_m_ = moment.hand_m;
            }
        }
        if (change_) change_(moment, bodies);
        fluid_->step(moment.dt_s, bodies, false);
        const gles::StepResult result = fluid_->wait_result();
        if (!result.loads.empty()) loads_ = result.loads;
        if (moment.holds_answer || loads_.empty()) return;
        answer_.force_n = loads_[motions_.held().value_or(0)].force_n;
        answer_.computed_for = now;
        answer_.fluid_period = Seconds(moment.scene->solver.dt_s);
        ++answer_.sequence;
    }
    std::vector<gles::Load> loads() override { return loads_; }
    FluidSnapshot answer() override { return answer_; }
    const gles::Fluid& fluid() const override { return *fluid_; }
    gles::GuardCounts guards() const override { return fluid_->guards(); }
    void reset() override {
        fluid_->reset();
        at_m_.reset();
        time_s_ = 0.0;
    }

  private:
    /// Until now; what runs down goes slower than it would.
    std::vector<gles::BodyState> bodies_at(double before_s, double dt_s) const {
        const double runs_s = running_down_s(time_s_, stop_s_);
        if (runs_s == time_s_) return motions_.at(time_s_, dt_s);
        const double goes_on_s = runs_s - running_down_s(before_s, stop_s_);
        std::vector<gles::BodyState> bodies = motions_.at(runs_s, std::max(goes_on_s, 1e-3 * dt_s));
        for (gles::BodyState& body : bodies) {
            body.velocity_m_s *= goes_on_s / dt_s;
            body.spin_rad_s *= goes_on_s / dt_s;
        }
        return bodies;
    }

    std::unique_ptr<gles::Fluid> fluid_;
    BodySchedule motions_;
    ChangeBodies change_;
    double stop_s_;
    std::vector<gles::Load> loads_;
    FluidSnapshot answer_;
    std::optional<glm::dvec3> at_m_;  ///< where the hand has held the body
    double time_s_ = 0.0;             ///< of the scene
};

/// The exhibit's fluid side, as `eddy run` drives it.
class Exhibit final : public Rig {
  public:
    Exhibit(gles::Gpu& gpu, const Scene& scene)
        : show_(gpu, scene, exchange_),
          quality_(quality_of(scene)),
          holds_(BodySchedule(scene).held().has_value()) {}

    void step(const Moment& moment, const PoseSnapshot& hand, Instant now) override {
        exchange_.pose.publish(hand);
        // The longest step that eddy run asks for after a stall.
        show_.update(now, Seconds(std::min(moment.dt_s, 0.1)), false);
        unknown_ = moment.holds_answer;
        if (unknown_) return;
        show_.publish(true);
        answer_ = exchange_.fluid.newest();
    }
    std::vector<gles::Load> loads() override {
        if (!holds_ || unknown_) return {};
        return {{answer().force_n, answer().torque_nm}};
    }
    FluidSnapshot answer() override { return answer_; }
    const gles::Fluid& fluid() const override { return show_.fluid(); }
    gles::GuardCounts guards() const override { return show_.guards(); }
    void reset() override { show_.reset(); }
    void change_preset() override {
        quality_ = with_preset(
            quality_, quality_.preset == SolverPreset::Fast ? SolverPreset::Precise : SolverPreset::Fast);
        show_.set_quality(quality_);
    }

  private:
    HapticExchange exchange_;
    Show show_;
    FluidSnapshot answer_{};  ///< the last that reached the hand
    Quality quality_;
    bool holds_;            ///< a body
    bool unknown_ = false;  ///< what this step did to it
};

}  // namespace

double taken_s(const gles::FluidSetup& setup, double dt_s) {
    gles::GuardCounts uncounted;
    return gles::guarded_step_s(dt_s, setup, uncounted).value_or(0.0);
}

std::unique_ptr<Rig> make_rig(gles::Gpu& gpu, const Scene& scene, const gles::FluidSetup& setup,
                              bool with_hand, ChangeBodies bodies, double stop_s) {
    if (with_hand) return std::make_unique<Exhibit>(gpu, scene);
    return std::make_unique<Steps>(gpu, scene, setup, std::move(bodies), stop_s);
}

}  // namespace eddy::stability
