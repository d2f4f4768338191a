#include "firmware/effects/measurement.h"

#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "gles/fluid/fluid.h"
#include "gles/gpu_timer.h"

namespace eddy::effects {
namespace {

/// A variant that takes its steps.
class Runner {
  public:
    Runner(gles::Gpu& gpu, const Scene& scene)
        : motions_(scene), fluid_(gles::make_fluid(gpu, fluid_setup(scene))), dt_s_(scene.solver.dt_s) {}

    void step() {
        ++n_;
        fluid_->step(dt_s_, motions_.at(static_cast<double>(n_) * dt_s_, dt_s_), false);
    }
    void wait() { fluid_->result(true); }

  private:
    BodySchedule motions_;
    std::unique_ptr<gles::Fluid> fluid_;
    double dt_s_;
    long n_ = 0;
};

void time_step(Runner& runner, std::optional<gles::GpuTimer>& timer, Timings& times) {
    const Stopwatch::Moment begin = Stopwatch::now();
    if (timer) timer->begin();
    runner.step();
    if (timer) timer->end();
    runner.wait();
    const Stopwatch::Moment end = Stopwatch::now();
    times.cpu_ms.push_back(end.cpu_ms - begin.cpu_ms);
    times.wall_ms.push_back(end.wall_ms - begin.wall_ms);
    // Where the GPU's clock was disturbed, the other one says the most the GPU can have worked.
    if (timer) times.gpu_ms.push_back(timer->milliseconds().value_or(times.wall_ms.back()));
}

CostClock best_clock(const Graphics& graphics) {
    if (graphics.in_software()) return CostClock::Cpu;
    return graphics.gpu.capabilities().timer_query ? CostClock::Gpu : CostClock::Wall;
}

}  // namespace

Measurement measure(Graphics& graphics, EffectStudy study, int repeats, const ShowProgress& show) {
    Measurement m{std::move(study), best_clock(graphics), {}};
    const double planning = 3.0, rounds = planning + kWarmUp + repeats;  // a plan is made of three steps
    for (const SceneVariant& variant : m.study.variants) {
        show(planning * static_cast<double>(m.variants.size()) / static_cast<double>(m.study.variants.size()),
             rounds);
        gles::Gpu own(graphics.gpu.capabilities());
        m.variants.push_back(
            {cost_of(own, fluid_setup(variant.scene), BodySchedule(variant.scene), variant.scene.solver.dt_s),
             {}});
    }
    std::vector<Runner> runners;
    for (const SceneVariant& variant : m.study.variants) runners.emplace_back(graphics.gpu, variant.scene);
    std::optional<gles::GpuTimer> timer;
    if (graphics.gpu.capabilities().timer_query) timer.emplace();
    for (int round = 0; round < kWarmUp + repeats; ++round)
        for (std::size_t v = 0; v < runners.size(); ++v) {
            Timings ignored;
            time_step(runners[v], timer, round < kWarmUp ? ignored : m.variants[v].times);
            show(planning + round + static_cast<double>(v + 1) / static_cast<double>(runners.size()), rounds);
        }
    return m;
}

std::vector<double> added_ms(const Measurement& measurement, const EffectAdded& added, CostClock clock) {
    const std::vector<double>& with = by(clock, measurement.with(added).times);
    const std::vector<double>& without = by(clock, measurement.without(added).times);
    std::vector<double> ms;
    for (std::size_t i = 0; i < with.size(); ++i) ms.push_back(with[i] - without[i]);
    return ms;
}

}  // namespace eddy::effects
