#include <fmt/format.h>

#include "firmware/body_schedule.h"
#include "firmware/destination.h"
#include "firmware/effects/measurement.h"
#include "firmware/effects/plot.h"
#include "firmware/effects/report.h"
#include "firmware/graphics.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/scene_grid.h"
#include "firmware/step_timer.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

Scene scene_of(const BenchOptions& options) {
    const std::string name = options.scene.empty() ? "everything" : options.scene;
    Scene scene = load_scene(name, options.set).scene;
    if (options.grids.size() > 1)
        throw InputError(
            fmt::format("--grid: --effects compares scenes on one grid, not on {}", options.grids.size()));
    if (!options.grids.empty()) scene = with_longest_side(std::move(scene), options.grids[0], kGridOption);
    if (effects::effects_of(scene).empty())
        throw InputError(fmt::format(
            "{}: this scene has no effect that could be left out; print-config --keys lists them", name));
    BodySchedule{scene};  // reads the paths
    return scene;
}

void check_destinations(const BenchOptions& options) {
    if (!options.json.empty()) check_destination("--json", options.json);
    if (options.plot.empty()) return;
    if (std::filesystem::path(options.plot).extension() != ".png")
        throw InputError(fmt::format("--plot: {} does not end in .png", options.plot));
    check_destination("--plot", options.plot);
}

void explain(const effects::EffectStudy& study, const BenchOptions& options) {
    const Scene& scene = study.variants[0].scene;
    const glm::ivec3& n = scene.tank.cells;
    fmt::print(
        "scene: {}; {} x {} x {} cells, preset {}. Each row is this scene with some effects left out, "
        "compiled anew:\n"
        "what is left out has no pass, no texture and no uniform. All {} take a step in turn, {} times after "
        "{} of\n"
        "warm-up. Passes, fetches and MB are what the plan of one step says (eddy simulate SCENE "
        "--plan).\n\n",
        scene.title, n.x, n.y, n.z, to_word(scene.solver.preset), study.variants.size(), options.repeats,
        kWarmUpSteps);
}

}  // namespace

int bench_effects(const BenchOptions& options) {
    effects::EffectStudy study = effects::study_effects(scene_of(options));
    check_destinations(options);
    const std::unique_ptr<Graphics> graphics = open_headless();
    const gles::Capabilities& driver = graphics->gpu.capabilities();
    if (!options.csv) {
        fmt::print("{} ({}, {})\n{}\n", driver.renderer, driver.vendor, driver.version, describe_machine());
        explain(study, options);
    }
    Progress progress("bench --effects");
    const effects::EffectCosts measured =
        effects::measure(*graphics, std::move(study), options.repeats,
                         [&](double done, double total) { progress.show(done, total); });
    progress.finish();
    if (options.csv)
        fmt::print("{}", effects::csv_of(measured));
    else
        fmt::print("{}\n{}\n{}", effects::table_of_variants(measured), effects::table_of_effects(measured),
                   effects::summary_of(measured));
    if (!options.json.empty()) replace_text_file(options.json, effects::json_of(measured, driver));
    if (!options.plot.empty() && !effects::plot(measured, driver, options.plot)) return 1;
    return 0;
}

}  // namespace eddy
