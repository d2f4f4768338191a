#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "firmware/body_schedule.h"
#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/input_error.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/scene_grid.h"
#include "firmware/step_timer.h"
#include "firmware/step_times.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

constexpr SolverPreset kPresets[] = {SolverPreset::Fast, SolverPreset::Precise, SolverPreset::Yang2009};
constexpr int kGrids[] = {25, 32, 48, 64, 96, 128};

/// One preset on one grid.
struct PresetTimes {
    int cells;  // along the longest side
    std::string preset;
    StepTimes times;
};

PresetTimes measure(gles::Gpu& gpu, Scene scene, int cells, SolverPreset preset, int repeats) {
    scene = with_longest_side(std::move(scene), cells);
    scene.solver.preset = preset;
    return {cells, std::string(to_word(preset)), time_steps(gpu, scene, repeats)};
}

void print(const PresetTimes& m, const PresetTimes* yardstick) {
    const double fetches = static_cast<double>(m.times.fetches);
    fmt::print(
        "\n{}^3 {}: {} passes, {:.1f} M fetches, {:.1f} MB written; a step cuts max|div u| {:.0f}-fold; {} "
        "repeats\n",
        m.cells, m.preset, m.times.passes, fetches / 1e6, static_cast<double>(m.times.bytes) / 1e6,
        m.times.divergence_cut, m.times.step.wall_ms.size());
    fmt::print("  {:<18}{:>10}{:>10}{:>10}{:>10}\n", "ms", "cpu p50", "cpu p95", "wall p50", "wall p95");
    const auto row = [](const std::string& name, const Timings& t) {
        fmt::print("  {:<18}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}\n", name, median(t.cpu_ms),
                   percentile_95(t.cpu_ms), median(t.wall_ms), percentile_95(t.wall_ms));
    };
    for (const auto& [name, timings] : m.times.stages) row(name, timings);
    row("whole step", m.times.step);
    for (const auto& [name, timings] : m.times.stages)
        if (name == "force")
            fmt::print("  force and torque: {:.2f} % of the step's cpu time\n",
                       100.0 * median(timings.cpu_ms) / median(m.times.step.cpu_ms));
    if (yardstick)
        fmt::print("  of yang2009: {:.3f} of the cpu time, {:.3f} of the fetches\n",
                   median(m.times.step.cpu_ms) / median(yardstick->times.step.cpu_ms),
                   fetches / static_cast<double>(yardstick->times.fetches));
}

nlohmann::ordered_json to_json(const Timings& t) {
    return {{"cpu_ms_p50", median(t.cpu_ms)},
            {"cpu_ms_p95", percentile_95(t.cpu_ms)},
            {"wall_ms_p50", median(t.wall_ms)},
            {"wall_ms_p95", percentile_95(t.wall_ms)},
            {"repeats", t.wall_ms.size()}};
}

std::string to_json(const std::vector<PresetTimes>& all, const gles::Capabilities& driver,
                    const Scene& scene) {
    nlohmann::ordered_json j;
    j["eddy_version"] = EDDY_VERSION;
    j["scene"] = scene.title;
    j["renderer"] = driver.renderer;
    j["gl_version"] = driver.version;
    j["machine"] = describe_machine();
    for (const PresetTimes& m : all) {
        nlohmann::ordered_json one{{"cells", m.cells},
                                   {"preset", m.preset},
                                   {"passes", m.times.passes},
                                   {"texels", m.times.texels},
                                   {"bytes_written", m.times.bytes},
                                   {"fetches", m.times.fetches},
                                   {"divergence_cut_p50", m.times.divergence_cut},
                                   {"step", to_json(m.times.step)}};
        for (const auto& [name, timings] : m.times.stages) one["stages"][name] = to_json(timings);
        j["measurements"].push_back(one);
    }
    return j.dump(2) + "\n";
}

}  // namespace

int bench(const BenchOptions& options) {
    const Scene scene = load_scene(options.scene.empty() ? "bench" : options.scene, options.set).scene;
    const std::vector<int> grids =
        options.grids.empty() ? std::vector<int>(std::begin(kGrids), std::end(kGrids)) : options.grids;
    for (const int cells : grids)
        with_longest_side(scene, cells, options.grids.empty() ? kNoGridOption : kGridOption);
    BodySchedule{scene};  // reads the paths
    if (!options.json.empty()) check_destination("--json", options.json);
    const std::unique_ptr<Graphics> graphics = open_headless();
    const gles::Capabilities& driver = graphics->gpu.capabilities();
    fmt::print("{} ({}, {})\n{}\n", driver.renderer, driver.vendor, driver.version, describe_machine());
    fmt::print(
        "scene: {}; up to {} repeats after {} steps of warm-up. yang2009 is the yardstick: the pipeline of "
        "the "
        "2009 paper\n"
        "with 40 Jacobi sweeps (the count is ours). Stages are timed with the GPU drained before and after "
        "each;\n"
        "whole steps are not, so they may be shorter than the sum.\n",
        scene.title, options.repeats, kWarmUpSteps);
    std::vector<PresetTimes> all;
    Progress progress("bench");
    const double total = static_cast<double>(grids.size() * std::size(kPresets));
    for (const int cells : grids) {
        const std::size_t first = all.size();
        for (const SolverPreset preset : kPresets) {
            all.push_back(measure(graphics->gpu, scene, cells, preset, options.repeats));
            progress.show(static_cast<double>(all.size()), total, fmt::format("{}^3", cells));
        }
        progress.finish();
        for (std::size_t i = first; i < all.size(); ++i)
            print(all[i], i + 1 == all.size() ? nullptr : &all.back());
    }
    if (!options.json.empty()) {
        replace_text_file(options.json, to_json(all, driver, scene));
        fmt::print("\nwritten to {}\n", options.json);
    }
    return 0;
}

}  // namespace eddy
