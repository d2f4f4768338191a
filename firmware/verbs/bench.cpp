#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "firmware/body_schedule.h"
#include "firmware/destination.h"
#include "firmware/fluid_setup.h"
#include "firmware/graphics.h"
#include "firmware/input_error.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/scene_grid.h"
#include "firmware/stopwatch.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"
#include "gles/fluid/fluid.h"

namespace eddy {
namespace {

constexpr SolverPreset kPresets[] = {SolverPreset::Fast, SolverPreset::Precise, SolverPreset::Yang2009};
constexpr int kGrids[] = {25, 32, 48, 64, 96, 128};
constexpr int kFewest = 5;          // repeats that are made however long they take
constexpr double kLongestS = 30.0;  // after this long on one preset and grid, no more repeats are begun
constexpr int kWarmUp =
    5;  // steps before timing starts: shaders are compiled, textures made, the pressure warm

/// One preset on one grid.
struct Measurement {
    int cells;  // along the longest side
    std::string preset;
    Timings step;  // whole steps, no waiting inside
    std::vector<std::pair<std::string, Timings>> stages;
    std::int64_t passes = 0, texels = 0, bytes = 0, fetches = 0;  // of one step
    double divergence_cut = 0.0;  // median factor by which a step cuts max |div u|
};

Measurement measure(gles::Gpu& gpu, Scene scene, int cells, SolverPreset preset, int repeats) {
    scene = with_longest_side(std::move(scene), cells);
    scene.solver.preset = preset;
    const BodySchedule motions(scene);
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    const double dt = scene.solver.dt_s;
    Stopwatch stopwatch(gpu);
    Measurement m{cells, std::string(to_word(preset)), {}, {}, 0, 0, 0, 0, 0.0};
    std::vector<double> cuts;
    long n = 0;
    const auto step = [&](bool diagnose) {
        ++n;
        fluid->step(dt, motions.at(static_cast<double>(n) * dt, dt), diagnose);
    };
    for (int i = 0; i < kWarmUp; ++i) {
        step(true);
        fluid->result(true);
    }
    // Three kinds of step in turn, so that a busy moment of the machine falls on all alike.
    const double give_up_ms = Stopwatch::now().wall_ms + 1e3 * kLongestS;
    for (int i = 0; i < repeats && (i < kFewest || Stopwatch::now().wall_ms < give_up_ms); ++i) {
        const Stopwatch::Moment begin = Stopwatch::now();
        step(false);
        fluid->result(true);
        const Stopwatch::Moment end = Stopwatch::now();
        m.step.cpu_ms.push_back(end.cpu_ms - begin.cpu_ms);
        m.step.wall_ms.push_back(end.wall_ms - begin.wall_ms);

        stopwatch.set_on(true);
        step(false);
        fluid->result(true);
        stopwatch.set_on(false);

        step(true);
        const gles::Diagnostics d = *fluid->wait_result().diagnostics;
        if (d.divergence_max_1_s > 0.0) cuts.push_back(d.divergence_before_1_s / d.divergence_max_1_s);
    }
    std::vector<gles::PassRecord> records;
    gpu.record(&records);
    step(false);
    gpu.record(nullptr);
    fluid->result(true);
    for (const gles::PassRecord& record : records) {
        ++m.passes;
        m.texels += record.texels;
        m.bytes += record.bytes;
        m.fetches += record.fetches;
    }
    for (const std::string& stage : stopwatch.stages()) m.stages.emplace_back(stage, stopwatch.of(stage));
    m.divergence_cut = median(cuts);
    return m;
}

void print(const Measurement& m, const Measurement* yardstick) {
    const double fetches = static_cast<double>(m.fetches);
    fmt::print(
        "\n{}^3 {}: {} passes, {:.1f} M fetches, {:.1f} MB written; a step cuts max|div u| {:.0f}-fold; {} "
        "repeats\n",
        m.cells, m.preset, m.passes, fetches / 1e6, static_cast<double>(m.bytes) / 1e6, m.divergence_cut,
        m.step.wall_ms.size());
    fmt::print("  {:<18}{:>10}{:>10}{:>10}{:>10}\n", "ms", "cpu p50", "cpu p95", "wall p50", "wall p95");
    const auto row = [](const std::string& name, const Timings& t) {
        fmt::print("  {:<18}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}\n", name, median(t.cpu_ms),
                   percentile_95(t.cpu_ms), median(t.wall_ms), percentile_95(t.wall_ms));
    };
    for (const auto& [name, timings] : m.stages) row(name, timings);
    row("whole step", m.step);
    for (const auto& [name, timings] : m.stages)
        if (name == "force")
            fmt::print("  force and torque: {:.2f} % of the step's cpu time\n",
                       100.0 * median(timings.cpu_ms) / median(m.step.cpu_ms));
    if (yardstick)
        fmt::print("  of yang2009: {:.3f} of the cpu time, {:.3f} of the fetches\n",
                   median(m.step.cpu_ms) / median(yardstick->step.cpu_ms),
                   fetches / static_cast<double>(yardstick->fetches));
}

nlohmann::ordered_json to_json(const Timings& t) {
    return {{"cpu_ms_p50", median(t.cpu_ms)},
            {"cpu_ms_p95", percentile_95(t.cpu_ms)},
            {"wall_ms_p50", median(t.wall_ms)},
            {"wall_ms_p95", percentile_95(t.wall_ms)},
            {"repeats", t.wall_ms.size()}};
}

std::string to_json(const std::vector<Measurement>& all, const gles::Capabilities& driver,
                    const Scene& scene) {
    nlohmann::ordered_json j;
    j["eddy_version"] = EDDY_VERSION;
    j["scene"] = scene.title;
    j["renderer"] = driver.renderer;
    j["gl_version"] = driver.version;
    j["machine"] = describe_machine();
    for (const Measurement& m : all) {
        nlohmann::ordered_json one{{"cells", m.cells},
                                   {"preset", m.preset},
                                   {"passes", m.passes},
                                   {"texels", m.texels},
                                   {"bytes_written", m.bytes},
                                   {"fetches", m.fetches},
                                   {"divergence_cut_p50", m.divergence_cut},
                                   {"step", to_json(m.step)}};
        for (const auto& [name, timings] : m.stages) one["stages"][name] = to_json(timings);
        j["measurements"].push_back(one);
    }
    return j.dump(2) + "\n";
}

}  // namespace

int bench(const BenchOptions& options) {
    const Scene scene = load_scene(options.scene.empty() ? "bench" : options.scene, options.set).scene;
    const std::vector<int> grids =
        options.grids.empty() ? std::vector<int>(std::begin(kGrids), std::end(kGrids)) : options.grids;
    for (const int cells : grids) with_longest_side(scene, cells);
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
        scene.title, options.repeats, kWarmUp);
    std::vector<Measurement> all;
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
