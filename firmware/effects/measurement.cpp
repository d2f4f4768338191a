#include "firmware/effects/measurement.h"

#include <deque>

#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "firmware/scene_steps.h"
#include "firmware/step_timer.h"

namespace eddy::effects {
namespace {

/// A variant that takes its steps, and what they take.
struct Runner {
    Runner(gles::Gpu& gpu, const Scene& scene)
        : steps(gpu, scene),
          timer(
              gpu, [this] { steps.take(); }, [this] { steps.wait(); }) {}
    SceneSteps steps;
    StepTimer timer;
};

}  // namespace

EffectCosts measure(Graphics& graphics, EffectStudy study, int repeats, const ShowProgress& show) {
    EffectCosts m{std::move(study), best_clock(graphics), {}};
    const double planning = 3.0, rounds = planning + kWarmUpSteps + repeats;  // a plan is made of three steps
    for (const SceneVariant& variant : m.study.variants) {
        show(planning * static_cast<double>(m.variants.size()) / static_cast<double>(m.study.variants.size()),
             rounds);
        gles::Gpu own(graphics.gpu.capabilities());
        m.variants.push_back(
            {cost_of(own, fluid_setup(variant.scene), BodySchedule(variant.scene), variant.scene.solver.dt_s),
             {}});
    }
    const std::size_t n = m.variants.size();
    std::deque<Runner> runners;
    for (const SceneVariant& variant : m.study.variants) {
        runners.emplace_back(graphics.gpu, variant.scene).timer.warm_up();
        show(planning + kWarmUpSteps * static_cast<double>(runners.size()) / static_cast<double>(n), rounds);
    }
    for (int round = 0; round < repeats; ++round)
        for (std::size_t v = 0; v < n; ++v) {
            runners[v].timer.time_step();
            show(planning + kWarmUpSteps + round + static_cast<double>(v + 1) / static_cast<double>(n),
                 rounds);
        }
    for (std::size_t v = 0; v < n; ++v) m.variants[v].times = runners[v].timer.times();
    return m;
}

std::vector<double> added_ms(const EffectCosts& costs, const EffectAdded& added, CostClock clock) {
    const std::vector<double>& with = by(clock, costs.with(added).times);
    const std::vector<double>& without = by(clock, costs.without(added).times);
    std::vector<double> ms;
    for (std::size_t i = 0; i < with.size(); ++i) ms.push_back(with[i] - without[i]);
    return ms;
}

}  // namespace eddy::effects
