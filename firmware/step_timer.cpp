#include "firmware/step_timer.h"

namespace eddy {

StepTimer::StepTimer(gles::Gpu& gpu, std::function<void()> take, std::function<void()> wait)
    : take_(std::move(take)), wait_(std::move(wait)) {
    if (gpu.capabilities().timer_query) gpu_timer_.emplace();
}

void StepTimer::warm_up() {
    for (int i = 0; i < kWarmUpSteps; ++i) {
        take_();
        wait_();
    }
}

void StepTimer::time_step() {
    const Stopwatch::Moment begin = Stopwatch::now();
    if (gpu_timer_) gpu_timer_->begin();
    take_();
    if (gpu_timer_) gpu_timer_->end();
    wait_();
    const Stopwatch::Moment end = Stopwatch::now();
    times_.cpu_ms.push_back(end.cpu_ms - begin.cpu_ms);
    times_.wall_ms.push_back(end.wall_ms - begin.wall_ms);
    if (gpu_timer_) times_.gpu_ms.push_back(gpu_timer_->milliseconds().value_or(times_.wall_ms.back()));
}

CostClock best_clock(const Graphics& graphics) {
    if (graphics.in_software()) return CostClock::Cpu;
    return graphics.gpu.capabilities().timer_query ? CostClock::Gpu : CostClock::Wall;
}

CostClock best_clock_of_stages(const Graphics& graphics) {
    return graphics.in_software() ? CostClock::Cpu : CostClock::Wall;
}

}  // namespace eddy
