#include "firmware/paper/force_cost.h"

#include "firmware/scene_grid.h"

namespace eddy::paper {
namespace {

ForceCost::Parts parts_of(const StepTimes& times, CostClock clock) {
    const auto ms = [&](const char* stage) { return median(by(clock, times.stage(stage))); };
    ForceCost::Parts parts{median(times.step.wall_ms), 0.0, ms("force") + ms("read back"),
                           ms("force integral")};
    for (const auto& [name, timings] : times.stages)
        if (name != "force" && name != "force integral" && name != "read back")
            parts.fluid += median(by(clock, timings));
    return parts;
}

}  // namespace

ForceCost measure_force_cost(gles::Gpu& gpu, const Scene& scene, int cells, int repeats, CostClock clock) {
    Scene yang = with_longest_side(scene, cells);
    yang.solver.preset = SolverPreset::Yang2009;
    yang.solver.force_sum = ForceSum::Gpu;
    const StepTimes on_gpu = time_steps(gpu, yang, repeats);
    yang.solver.force_sum = ForceSum::Cpu;
    return {cells, parts_of(on_gpu, clock), parts_of(time_steps(gpu, yang, repeats), clock)};
}

}  // namespace eddy::paper
