#include "firmware/step_times.h"

#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "gles/fluid/fluid.h"

namespace eddy {
namespace {

constexpr int kFewest = 5;          // repeats that are made however long they take
constexpr double kLongestS = 30.0;  // after this long no more repeats are begun

}  // namespace

Timings StepTimes::stage(const std::string& name) const {
    for (const auto& [stage, timings] : stages)
        if (stage == name) return timings;
    return {};
}

StepTimes time_steps(gles::Gpu& gpu, const Scene& scene, int repeats) {
    const BodySchedule motions(scene);
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    const double dt = scene.solver.dt_s;
    Stopwatch stopwatch(gpu);
    StepTimes times;
    std::vector<double> cuts;
    long n = 0;
    const auto step = [&](bool diagnose) {
        ++n;
        fluid->step(dt, motions.at(static_cast<double>(n) * dt, dt), diagnose);
    };
    for (int i = 0; i < kWarmUpSteps; ++i) {
        step(true);
        fluid->result(true);
    }
    // Three kinds of step in turn, so that a busy moment of the machine falls on all alike.
    const double give_up_ms = Stopwatch::now().wall_ms + 1e3 * kLongestS;
    for (int i = 0; i < repeats && (i < kFewest || Stopwatch::now().wall_ms < give_up_ms); ++i) {
        const Stopwatch::Moment begin = Stopwatch::now();
        step(false);
        fluid->result(true);
        const Stopwatch::Moment end = Stopwatch::now();
        times.step.cpu_ms.push_back(end.cpu_ms - begin.cpu_ms);
        times.step.wall_ms.push_back(end.wall_ms - begin.wall_ms);

        stopwatch.set_on(true);
        step(false);
        fluid->result(true);
        stopwatch.set_on(false);

        step(true);
        const gles::Diagnostics d = *fluid->wait_result().diagnostics;
        if (d.divergence_max_1_s > 0.0) cuts.push_back(d.divergence_before_1_s / d.divergence_max_1_s);
    }
    std::vector<gles::PassRecord> records;
    gpu.record(&records);
    step(false);
    gpu.record(nullptr);
    fluid->result(true);
    for (const gles::PassRecord& record : records) {
        ++times.passes;
        times.texels += record.texels;
        times.bytes += record.bytes;
        times.fetches += record.fetches;
    }
    for (const std::string& stage : stopwatch.stages()) times.stages.emplace_back(stage, stopwatch.of(stage));
    times.divergence_cut = median(cuts);
    return times;
}

}  // namespace eddy
