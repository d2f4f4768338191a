#include "firmware/step_times.h"

#include "firmware/scene_steps.h"
#include "firmware/step_timer.h"

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
    SceneSteps steps(gpu, scene);
    StepTimer timer(
        gpu, [&] { steps.take(); }, [&] { steps.wait(); });
    Stopwatch stopwatch(gpu);
    StepTimes times;
    std::vector<double> cuts;
    timer.warm_up();
    // Three kinds of step in turn, so that a busy moment of the machine falls on all alike.
    const double give_up_ms = Stopwatch::now().wall_ms + 1e3 * kLongestS;
    for (int i = 0; i < repeats && (i < kFewest || Stopwatch::now().wall_ms < give_up_ms); ++i) {
        timer.time_step();

        stopwatch.set_on(true);
        steps.take();
        steps.wait();
        stopwatch.set_on(false);

        steps.take(true);
        const gles::Diagnostics d = *steps.wait().diagnostics;
        if (d.divergence_max_1_s > 0.0) cuts.push_back(d.divergence_before_1_s / d.divergence_max_1_s);
    }
    times.step = timer.times();
    std::vector<gles::PassRecord> records;
    gpu.record(&records);
    steps.take();
    gpu.record(nullptr);
    steps.wait();
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
