#include "firmware/accuracy/sweep/measure.h"

#include "firmware/accuracy/study.h"
#include "firmware/accuracy/sweep/problem.h"
#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "firmware/stopwatch.h"
#include "gles/gpu_timer.h"

namespace eddy::accuracy::sweep {
namespace {

constexpr int kWarmUp = 5;  // steps: shaders are compiled, textures made, the pressure warm
constexpr int kRepeats = 30;

Spread spread(const std::vector<double>& ms) {
    return {median(ms), percentile_95(ms)};
}

/// Steps of a scene of their own, so that nothing but the step is in them.
void time_steps(gles::Gpu& gpu, const Scene& scene, bool stages, Measurement& m) {
    const BodySchedule motions(scene);
    gles::FluidSetup setup = fluid_setup(scene);
    setup.force_methods = scene.outputs.force_methods;
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    const double dt = scene.solver.dt_s;
    const auto step = [&] {
        fluid->step(dt, motions.at(static_cast<double>(fluid->steps() + 1) * dt, dt), false);
        if (!scene.bodies.empty()) fluid->wait_result();
        if (setup.force_methods) fluid->force_methods();
    };
    std::optional<gles::GpuTimer> timer;
    if (gpu.capabilities().timer_query) timer.emplace();
    Timings whole;
    std::vector<double> gpu_ms;
    for (int i = 0; i < kWarmUp; ++i) step();
    for (int i = 0; i < kRepeats; ++i) {
        const Stopwatch::Moment begin = Stopwatch::now();
        if (timer) timer->begin();
        step();
        if (timer) timer->end();
        const Stopwatch::Moment end = Stopwatch::now();
        whole.cpu_ms.push_back(end.cpu_ms - begin.cpu_ms);
        whole.wall_ms.push_back(end.wall_ms - begin.wall_ms);
        if (!timer) continue;
        if (const std::optional<double> ms = timer->milliseconds()) gpu_ms.push_back(*ms);
    }
    m.repeats = kRepeats;
    m.wall_ms = spread(whole.wall_ms);
    m.cpu_ms = spread(whole.cpu_ms);
    if (!gpu_ms.empty()) m.gpu_ms = spread(gpu_ms);
    if (!stages) return;
    Stopwatch stopwatch(gpu);
    for (int i = 0; i < kRepeats; ++i) {
        stopwatch.set_on(true);
        step();
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
    time_steps(gpu, scene, has_stages(point), m);
    return m;
}

}  // namespace eddy::accuracy::sweep
