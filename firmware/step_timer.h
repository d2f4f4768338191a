#pragma once
#include <functional>
#include <optional>

#include "firmware/graphics.h"
#include "firmware/stopwatch.h"
#include "gles/gpu_timer.h"

namespace eddy {

/// Steps before timing starts: shaders are compiled, textures made, the pressure warm. (Of a first step of all, llvmpipe's own
/// clock tells hours.)
inline constexpr int kWarmUpSteps = 5;

/// Times whole steps, one at a time, so that other work, or the steps of other scenes, may come between them.
class StepTimer {
  public:
    /// `take` asks for a step; `wait` returns when what it measured has come back.
    StepTimer(gles::Gpu& gpu, std::function<void()> take, std::function<void()> wait);

    /// Takes kWarmUpSteps.
    void warm_up();
    /// Takes a step. Processor and wall time are those of taking it and of the waiting; the GPU's own, where the driver tells
    /// it, is that of its work alone, or, where something disturbed its clock, the wall time: it cannot have worked for longer.
    void time_step();
    /// A sample for each step that was timed.
    const Timings& times() const { return times_; }

  private:
    std::function<void()> take_, wait_;
    std::optional<gles::GpuTimer> gpu_timer_;
    Timings times_;
};

/// The clock that tells best what a whole step costs here.
CostClock best_clock(const Graphics& graphics);
/// The same of a stage (Stopwatch), which the GPU's own clock does not time.
CostClock best_clock_of_stages(const Graphics& graphics);

}  // namespace eddy
