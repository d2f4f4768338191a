#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "config/scene.h"
#include "firmware/stopwatch.h"

namespace eddy {

/// What a step of a scene takes, and how much it draws.
struct StepTimes {
    Timings step;                                         ///< whole steps, no waiting inside
    std::vector<std::pair<std::string, Timings>> stages;  ///< with the GPU drained before and after each
    std::int64_t passes = 0, texels = 0, bytes = 0, fetches = 0;  ///< of one step
    double divergence_cut = 0.0;  ///< median factor by which a step cuts max |div u|

    /// Times of a stage; empty if the step has none of that name.
    Timings stage(const std::string& name) const;
};

/// Times `repeats` steps after the warm-up; fewer, but at least five, if they take longer than half a minute.
StepTimes time_steps(gles::Gpu& gpu, const Scene& scene, int repeats);

}  // namespace eddy
