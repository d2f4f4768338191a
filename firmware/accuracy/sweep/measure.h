#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/accuracy/sweep/plan.h"
#include "gles/gpu.h"

namespace eddy::accuracy::sweep {

/// Of repeated work [ms].
struct Spread {
    double p50 = 0.0, p95 = 0.0;
    bool operator==(const Spread&) const = default;
};

/// What a point was found to be.
struct Measurement {
    std::size_t index = 0;  ///< in the plan
    Point point = {};
    double error = 0.0;
    double dt_s = 0.0;
    int repeats = 0;  ///< steps that were timed, after a warm-up
    Spread wall_ms = {}, cpu_ms = {};
    std::optional<Spread> gpu_ms = {};  ///< by the GPU's own clock, where it has one
    /// Median wall time of each stage [ms], the GPU drained before and after; only where has_stages().
    std::vector<std::pair<std::string, double>> stages = {};
    bool operator==(const Measurement&) const = default;
};

/// `label`: what the progress line says.
Measurement measure(gles::Gpu& gpu, const Point& point, std::size_t index, const std::string& label);

}  // namespace eddy::accuracy::sweep
