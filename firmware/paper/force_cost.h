#pragma once
#include "firmware/step_times.h"

namespace eddy::paper {

/// What the force costs in the pipeline of 2009, added up on the GPU and, as the paper's own baseline, on the CPU.
struct ForceCost {
    /// Medians [ms].
    struct Parts {
        double step;  ///< wall time of the whole
        double fluid, force,
            integral;  ///< by the clock asked for; the integral is the part of the force that adds up
    };
    int cells;  ///< along each side
    Parts on_gpu, on_cpu;
};

/// On one grid. The flow is the same in both: only where the force of every cell is added up differs.
ForceCost measure_force_cost(gles::Gpu& gpu, const Scene& scene, int cells, int repeats, CostClock clock);

}  // namespace eddy::paper
