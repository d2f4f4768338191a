#include "firmware/stability/trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "firmware/fluid_setup.h"
#include "firmware/show.h"
#include "firmware/stability/hand.h"
#include "firmware/stability/ledger.h"
#include "firmware/stability/rig.h"
#include "firmware/stability/transport_watch.h"
#include "gles/fluid/step_guard.h"

namespace eddy::stability {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Steps between looks into the fields: to bring them to the processor must not cost more than the step.
long steps_between_looks(const glm::ivec3& n, long steps) {
    const long cells = long{n.x} * n.y * n.z;
    const long by_size = cells <= 1000 ? 1 : cells <= 20000 ? 4 : cells <= 60000 ? 10 : 25;
    return std::max(by_size, steps / 1000);
}

/// Cases at once, as one.
struct Mixture {
    Scene scene;
    long steps;  ///< in which what the case wants is judged
    double calm_share = 1.0, calm_s = 0.0, narrowing = 1.0;
    bool with_hand = false, puts_faults = false, looks_always = false;
    long pardon_steps = 0;

    double dt_s() const { return scene.solver.dt_s; }
    /// When the scene's own motion stops, if it does.
    double stop_s() const {
        return calm_s > 0.0 ? dt_s() * static_cast<double>(steps) : std::numeric_limits<double>::infinity();
    }
    double calm_from_s() const {
        return calm_s > 0.0 ? stop_s() + kRunDownS : dt_s() * static_cast<double>(steps) * (1.0 - calm_share);
    }
    long all_steps() const {
        return calm_s > 0.0 ? steps + std::lround((kRunDownS + calm_s) / dt_s()) : steps;
    }
};

/// A case that compares itself with the common scene does so for so many steps: after them differences of rounding have grown
/// by what flow there is.
constexpr long kCompared = 60;

Mixture mixture_of(std::span<const Case* const> cases, const Trial& trial, long most_steps) {
    Mixture all{common_scene(trial), cases.size() > 1 ? kStepsOfPair : cases.front()->steps};
    bool wants_steps = false;
    for (const Case* one : cases) {
        if (one->change) one->change(all.scene);
        all.calm_share = std::min(all.calm_share, one->calm_share);
        if (one->narrowing) all.narrowing *= one->narrowing(trial.cells);
        all.with_hand |= one->drive == Drive::Hand;
        wants_steps |= one->drive == Drive::Steps;
        all.puts_faults |= one->puts_faults;
        all.looks_always |= one->looks_always;
        all.pardon_steps = std::max(all.pardon_steps, one->pardon_steps);
    }
    all.with_hand &= !wants_steps;
    all.steps = std::min(all.steps, most_steps);
    if (cases.size() == 1 && all.steps == cases.front()->steps) all.calm_s = cases.front()->calm_s;
    if (all.calm_s > 0.0) falls_silent(all.scene, all.stop_s());
    return all;
}

gles::FluidSetup setup_of(std::span<const Case* const> cases, const Scene& scene) {
    gles::FluidSetup setup = fluid_setup(scene);
    for (const Case* one : cases)
        if (one->solids) one->solids(setup);
    return setup;
}

/// A trial under way.
class Run {
  public:
    Run(gles::Gpu& gpu, std::span<const Case* const> cases, const Trial& trial, Mixture mixture)
        : gpu_(gpu),
          cases_(cases),
          mixture_(std::move(mixture)),
          setup_(setup_of(cases, mixture_.scene)),
          gate_{.max_force_n = mixture_.scene.haptics.max_force_n},
          rule_(tank_of(setup_), {.most_n = gate_.max_force_n}),
          between_looks_(mixture_.looks_always ? 1 : steps_between_looks(trial.cells, mixture_.steps)),
          ledger_(mixture_.scene, setup_, mixture_.narrowing,
                  between_looks_ == 1 ? Ledger::Inflow::Seen : Ledger::Inflow::Estimated),
          at_rest_(ledger_.at_rest()),
          hand_(orders_for(mixture_.scene, setup_), gate_),
          rig_(make_rig(
              gpu, mixture_.scene, setup_, mixture_.with_hand,
              [this](const Moment& moment, std::vector<gles::BodyState>& bodies) {
                  for (const Case* one : cases_)
                      if (one->bodies) one->bodies(moment, bodies);
              },
              mixture_.stop_s())) {
        if (mixture_.puts_faults) faults_.emplace(gpu);
        if (alone().watches_transport) transport_.emplace(gpu);
        history_.tank = tank_of(setup_);
        history_.gravity_m_s2 = glm::length(setup_.gravity_m_s2);
        history_.planned_steps = mixture_.steps;
        const Fields start = download(rig_->fluid());
        history_.start_energy_j = kinetic_energy_j(history_.tank, start);
        history_.start_speed_m_s = largest_speed_m_s(history_.tank, start);
        rule_.begin(start);
    }

    /// What is red goes on, to show how far it goes; but numbers that are none only spread.
    bool goes_on() const {
        const bool enough = rule_.failed() && (rule_.verdict().non_finite > 0 || alone().ends_when_red);
        return step_ < mixture_.all_steps() && !enough;
    }
    void step();
    Outcome outcome();
    const History& history() const { return history_; }
    void compare_with(const History& common) {
        for (const History::Step& step : common.steps)
            history_.common_n.push_back(step.loads.empty() ? glm::dvec3(0.0) : step.loads[0].force_n);
    }

  private:
    Moment moment_now() const;
    void prepare(const Moment& moment);
    std::vector<gles::Load> loads() const;
    void judge_transport();
    void judge_own_check(const Moment& moment);
    void judge_life();
    void judge_wants();
    void look(const Moment& moment);
    /// What it wants besides the rule, and has to say; of two at once nothing can be asked.
    const Case& alone() const {
        static const Case nothing;
        return cases_.size() == 1 ? *cases_[0] : nothing;
    }

    gles::Gpu& gpu_;
    std::span<const Case* const> cases_;
    Mixture mixture_;
    gles::FluidSetup setup_;
    GateLimits gate_;
    Rule rule_;
    long between_looks_;
    Ledger ledger_;
    std::vector<gles::Load> at_rest_;
    Hand hand_;
    std::unique_ptr<Rig> rig_;
    std::optional<Faults> faults_;
    std::optional<TransportWatch> transport_;
    History history_;
    long step_ = 0, resets_ = 0, pardoned_until_ = 0, unsound_ = 0;
    double time_s_ = 0.0, fluid_s_ = 0.0, unseen_s_ = 0.0;
    std::string remark_;
};

Moment Run::moment_now() const {
    Moment moment{
        .step = step_, .time_s = time_s_, .calm_from_s = mixture_.calm_from_s(), .scene = &mixture_.scene};
    moment.dt_s = mixture_.dt_s();
    moment.hand_m = stroke_m(moment);
    for (const Case* one : cases_)
        if (one->script) one->script(moment);
    return moment;
}

/// What happens between two steps.
void Run::prepare(const Moment& moment) {
    for (const Fault& fault : moment.faults) {
        faults_->put(rig_->fluid(), fault);
        if (!moment.reset) pardoned_until_ = step_ + mixture_.pardon_steps;
    }
    if (moment.reset) {
        rig_->reset();
        fluid_s_ = 0.0;
        ++resets_;
    }
    if (moment.change_preset) rig_->change_preset();
    if (faults_) faults_->begin_step(rig_->fluid());
}

void Run::judge_transport() {
    const double beyond = transport_->overshoot_m_s(), speed = ledger_.justified().speed_m_s;
    if (beyond > 1e-5 * speed)  // rounding
        rule_.blame(step_ + 1,
                    fmt::format("transport makes a component of the velocity {:.3g} m/s larger than any was",
                                beyond));
}

/// What the fluid says of itself after each step: between two looks a texel may fall ill and be healed.
void Run::judge_own_check(const Moment& moment) {
    const long before = std::exchange(unsound_, rig_->guards().unsound_steps);
    // What a step left comes back with the next where a hand waits for no answer.
    if (unsound_ == before || moment.change_preset || step_ <= pardoned_until_ + 1) return;
    // A scene may ask for more than any flow may be given: then nothing else is to be expected.
    if (ledger_.justified().speed_m_s > gles::sound(setup_, mixture_.scene.solver.dt_s).fastest_m_s) return;
    rule_.blame(step_ + 1, "by its own check the fluid held a texel, or gave a load, that cannot be");
}

/// A fluid that does nothing, and a force that is none, keep every rule.
void Run::judge_life() {
    double way_m = 0.0, force_n = 0.0, energy_j = 0.0;
    bool felt = false;
    for (const History::Step& step : history_.steps) {
        felt |= !step.loads.empty();
        for (const gles::Load& load : step.loads) force_n = std::max(force_n, glm::length(load.force_n));
        for (const gles::BodyState& body : step.bodies) way_m += glm::length(body.velocity_m_s) * step.dt_s;
    }
    for (const History::Look& look : history_.looks) energy_j = std::max(energy_j, look.energy_j);
    if (!(way_m > history_.tank.cell_m)) return;
    if (!(energy_j > 0.0)) rule_.blame(step_, "bodies moved and the fluid never did");
    if (felt && !(force_n > 0.0)) rule_.blame(step_, "bodies moved and felt nothing");
}

std::vector<gles::Load> Run::loads() const {
    std::vector<gles::Load> loads = rig_->loads();
    for (std::size_t i = 0; i < std::min(loads.size(), at_rest_.size()); ++i)
        loads[i].force_n -= at_rest_[i].force_n;
    return loads;
}

void Run::step() {
    const Moment moment = moment_now();
    prepare(moment);
    hand_.tick(moment.dt_s, moment.hand_m, rig_->answer(), !moment.holds_answer, rule_, history_);
    const bool watched = transport_ && step_ % between_looks_ == 0;
    if (watched) transport_->begin_step(rig_->fluid());
    const Clock::time_point start = Clock::now();
    rig_->step(moment, hand_.pose(), hand_.now());
    const double wall_s = seconds_since(start);
    if (watched) judge_transport();
    const double passed_s = taken_s(setup_, moment.dt_s);
    // The hand moves on while the machine stalls; without one there is no clock but the fluid's.
    time_s_ += mixture_.with_hand ? moment.dt_s : passed_s;
    fluid_s_ += passed_s;
    unseen_s_ += passed_s;
    const std::vector<gles::BodyState>& bodies = rig_->fluid().bodies();
    history_.steps.push_back(
        {time_s_, passed_s, moment.disturbs(), resets_, loads(), bodies, rig_->force_methods(), wall_s});
    const std::vector<gles::Load>& felt = history_.steps.back().loads;
    // With a hand only its own load comes back: what other bodies do is then counted by their speed.
    ledger_.add(fluid_s_, passed_s, bodies, felt.size() == bodies.size() ? felt : std::vector<gles::Load>());
    judge_own_check(moment);
    look(moment);
    if (++step_ == mixture_.steps) judge_wants();
}

void Run::look(const Moment& moment) {
    const bool pardoned = step_ < pardoned_until_;
    const bool looks = moment.look || pardoned || step_ == pardoned_until_ || step_ % between_looks_ == 0 ||
                       step_ + 1 == mixture_.steps || step_ + 1 == mixture_.all_steps();
    std::optional<Fields> fields;
    if (looks) {
        fields = download(rig_->fluid());
        history_.looks.push_back(look_at(history_.tank, *fields, step_));
        if (const auto& measure = alone().measure)
            history_.looks.back().measured = measure(gpu_, rig_->fluid(), *fields, fluid_s_);
        ledger_.add_fields(std::exchange(unseen_s_, 0.0), *fields);
    }
    rule_.see({.step = step_ + 1,
               .time_s = time_s_,
               .justified = ledger_.justified(),
               .fields = fields ? &*fields : nullptr,
               .loads = history_.steps.back().loads,
               .disturbed = moment.disturbs(),
               .pardoned = pardoned});
}

/// A criterion is about what happened to the end.
void Run::judge_wants() {
    if (!alone().may_be_idle) judge_life();
    if (!rule_.failed() && alone().complaint)
        if (const auto complaint = alone().complaint(history_)) rule_.blame(step_, *complaint);
    if (alone().remark) remark_ = alone().remark(history_);
    for (const Case* one : cases_)
        if (mixture_.steps < one->least_steps)
            remark_ += fmt::format("{}not judged: all of {}, which takes {} steps",
                                   remark_.empty() ? "" : "; ", one->name, one->least_steps);
}

Outcome Run::outcome() {
    return {.steps = step_, .verdict = rule_.verdict(), .remark = remark_};
}

}  // namespace

Plan plan_of(std::span<const Case* const> cases, const Trial& trial, long most_steps) {
    const Mixture all = mixture_of(cases, trial, most_steps);
    return {.steps = all.all_steps(),
            .calm_s = all.dt_s() * static_cast<double>(all.all_steps()) - all.calm_from_s()};
}

Outcome try_out(gles::Gpu& gpu, std::span<const Case* const> cases, const Trial& trial, long most_steps) {
    const Clock::time_point start = Clock::now();
    Outcome outcome;
    long steps = 0;
    try {
        Run run(gpu, cases, trial, mixture_of(cases, trial, most_steps));
        if (cases.size() == 1 && cases[0]->compares) {
            const Case common{.name = "common", .drive = cases[0]->drive, .steps = cases[0]->steps};
            const Case* const alone[] = {&common};
            Run reference(gpu, alone, trial, mixture_of(alone, trial, most_steps));
            for (long n = 0; n < kCompared && reference.goes_on(); ++n) reference.step();
            run.compare_with(reference.history());
        }
        for (; run.goes_on(); ++steps) run.step();
        outcome = run.outcome();
    } catch (const std::exception& e) {
        // Whatever the program gives up at is a failure of the case, not of the laboratory.
        outcome.steps = steps;
        outcome.verdict.pass = false;
        outcome.verdict.reason = fmt::format("step {}: {}", steps + 1, e.what());
    }
    outcome.wall_s = seconds_since(start);
    return outcome;
}

}  // namespace eddy::stability
