#include "firmware/accuracy/sweep/measure.h"

#include "firmware/accuracy/study.h"
#include "firmware/accuracy/sweep/problem.h"
#include "firmware/scene_steps.h"
#include "firmware/step_timer.h"

namespace eddy::accuracy::sweep {
namespace {

constexpr int kRepeats = 30;

Spread spread(const std::vector<double>& ms) {
    return {median(ms), percentile_95(ms)};
}

/// Steps of a scene of their own, so that nothing but the step is in them.
void add_times(gles::Gpu& gpu, const Scene& scene, bool stages, Measurement& m) {
    SceneSteps steps(gpu, scene);
    StepTimer timer(
        gpu, [&] { steps.take(); }, [&] { steps.wait(); });
    timer.warm_up();
    for (int i = 0; i < kRepeats; ++i) timer.time_step();
    m.repeats = kRepeats;
    m.wall_ms = spread(timer.times().wall_ms);
    m.cpu_ms = spread(timer.times().cpu_ms);
    if (!timer.times().gpu_ms.empty()) m.gpu_ms = spread(timer.times().gpu_ms);
    if (!stages) return;
    Stopwatch stopwatch(gpu);
    for (int i = 0; i < kRepeats; ++i) {
        stopwatch.set_on(true);
        steps.take();
        steps.wait();
    }
    for (const std::string& stage : stopwatch.stages())
        m.stages.emplace_back(stage, median(stopwatch.of(stage).wall_ms));
}

}  // namespace

Measurement measure(gles::Gpu& gpu, const Point& point, std::size_t index, const std::string& label) {
    const Problem& problem = problem_named(point.problem);
    const Scene scene = applied(scene_on_grid(problem.of, point.setting.cells), point.setting);
    Measurement m{.index = index, .point = point, .dt_s = scene.solver.dt_s};
    {
        Laboratory lab(gpu, scene, label);
        m.error = problem.measure(lab, point.setting);
    }
    add_times(gpu, scene, has_stages(point), m);
    return m;
}

}  // namespace eddy::accuracy::sweep
