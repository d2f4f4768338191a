#include <fmt/format.h>

#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/machine.h"
#include "firmware/paper/figures.h"
#include "firmware/progress.h"
#include "firmware/scene_grid.h"
#include "firmware/step_timer.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

constexpr int kGrids[] = {25, 40, 55, 70, 85, 100};  // those of the paper's figures, 25 to 100
constexpr int kTableGrid = 70;                       // that of its Table I

}  // namespace

int bench_paper(const BenchOptions& options) {
    const Scene scene = load_scene(options.scene.empty() ? "bench" : options.scene, options.set).scene;
    const std::vector<int> grids =
        options.grids.empty() ? std::vector<int>(std::begin(kGrids), std::end(kGrids)) : options.grids;
    for (const int cells : grids)
        with_longest_side(scene, cells, options.grids.empty() ? kNoGridOption : kGridOption);
    prepare_folder("--paper", options.paper);
    const std::unique_ptr<Graphics> graphics = open_headless();
    const std::string renderer = graphics->gpu.capabilities().renderer;
    fmt::print("{}\n{}\nscene: {}; up to {} repeats after {} steps of warm-up\n\n", renderer,
               describe_machine(), scene.title, options.repeats, kWarmUpSteps);
    const CostClock clock = best_clock_of_stages(*graphics);
    fmt::print("{:<14}{:<30}{}\n", fmt::format("{} ms", to_string(clock)), "    added up on the GPU",
               "    added up on the CPU");
    fmt::print("  {:<12}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "grid", "step", "force", "its sum", "step",
               "force", "its sum");
    Progress progress("bench");
    std::vector<paper::ForceCost> costs;
    std::vector<paper::Implementation> ours;
    const int table_grid = options.grids.empty() ? kTableGrid : grids.back();
    const auto row_of = [&](SolverPreset preset) {
        Scene one = with_longest_side(scene, table_grid);
        one.solver.preset = preset;
        const StepTimes times = time_steps(graphics->gpu, one, options.repeats);
        return paper::Implementation{fmt::format("Eddy, `{}`", to_word(preset)),
                                     fmt::format("{0} × {0} × {0}", table_grid),
                                     1e3 / median(times.step.wall_ms), renderer};
    };
    for (std::size_t i = 0; i < grids.size(); ++i) {
        progress.show(static_cast<double>(i), static_cast<double>(grids.size()),
                      fmt::format("{}^3", grids[i]));
        costs.push_back(paper::measure_force_cost(graphics->gpu, scene, grids[i], options.repeats, clock));
        progress.finish();
        const paper::ForceCost& c = costs.back();
        fmt::print("  {:<12}", fmt::format("{}^3", c.cells));
        for (const paper::ForceCost::Parts& p : {c.on_gpu, c.on_cpu})
            fmt::print("{:>10.2f}{:>10.2f}{:>10.2f}", p.step, p.force, p.integral);
        fmt::print("\n");
    }
    for (const SolverPreset preset : {SolverPreset::Yang2009, SolverPreset::Fast, SolverPreset::Precise})
        ours.push_back(row_of(preset));
    const bool drawn = paper::draw_figures(options.paper, costs, ours, renderer, clock);
    fmt::print("\n{}paper.csv and paper.md written to {}\n", drawn ? "figures, " : "", options.paper);
    return drawn ? 0 : 1;
}

}  // namespace eddy
