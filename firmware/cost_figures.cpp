#include "firmware/cost_figures.h"

#include <fmt/format.h>

#include <algorithm>

namespace eddy {
namespace {

constexpr std::ptrdiff_t kRecent = 15;  // measurements a time is the median of
constexpr double kRateMemory = 30.0;    // steps over which the rate is smoothed

double recent_ms(const std::vector<double>& times) {
    const auto count = std::min(kRecent, static_cast<std::ptrdiff_t>(times.size()));
    return median({times.end() - count, times.end()});
}

std::string counted(int n, std::string_view what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace

void StepRate::add_step() {
    const Seconds now = clock_.now();
    if (last_) {
        const double period_s = (now - *last_).count();
        period_s_ += (period_s - period_s_) / (period_s_ > 0.0 ? kRateMemory : 1.0);
    }
    last_ = now;
}

CostFigures cost_figures(const Scene& scene, const Show& show, const Stopwatch& stopwatch,
                         const StepRate& rate) {
    CostFigures figures;
    figures.preset = to_word(show.quality().preset);
    figures.cells = show.fluid().setup().cells;
    const gles::SolverSetup& solver = show.fluid().setup().solver;
    figures.iterations = show.fluid().setup().imposed             ? counted(0, "cycle")
                         : solver.method == gles::Method::CutCell ? counted(solver.cycles, "cycle")
                                                                  : counted(solver.jacobi_sweeps, "sweep");
    const ShowFigures& shown = show.figures();
    figures.steps_per_s = rate.per_s();
    figures.target_steps_per_s = 1.0 / scene.solver.dt_s;
    figures.divergence_before_1_s = shown.divergence_before_1_s;
    figures.divergence_after_1_s = shown.divergence_after_1_s;
    for (const std::string& stage : stopwatch.stages()) {
        const double ms = recent_ms(stopwatch.of(stage).wall_ms);
        if (stage == "light" || stage == "render" || stage == "text") {
            figures.picture_ms += ms;
        } else if (stage != "diagnose") {  // only steps that are measured are
            figures.stages.push_back({stage, ms});
            figures.step_ms += ms;
        }
    }
    figures.ripple = show.ripple();
    return figures;
}

}  // namespace eddy
