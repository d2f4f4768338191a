#include <fmt/format.h>

#include "config/scene.h"
#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/input_error.h"
#include "firmware/progress.h"
#include "firmware/quality/tuner.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

void print(const Tuning& t) {
    fmt::print("{}\n{}\nmade {}\n\n", t.renderer, t.machine, t.made_at);
    fmt::print(
        "At {:.3g} steps a second a period is {:.3g} ms. A picture takes {:.3g} ms; {:.3g} ms are left for a "
        "step, and "
        "95 of\n100 steps must keep to {:.0f} % of that. Error: of the force on a ball, as many cells across "
        "as the body "
        "in the\nhand, that speeds up.\n\n",
        t.target_hz, 1e3 / t.target_hz, t.picture_ms, t.budget_ms, 100.0 * kTuningMargin);
    fmt::print("  {:<26}{:>12}{:>12}{:>10}\n", "", "ms a step", "ms, p95", "error");
    for (std::size_t i = 0; i < t.ladder.size(); ++i) {
        const Rung& rung = t.ladder[i];
        fmt::print("{} {:<26}{:>12.1f}{:>12.1f}{:>8.1f} %\n", i == t.chosen ? '>' : ' ',
                   describe(rung.quality), rung.step_ms, rung.step_ms_p95, 100.0 * rung.force_error);
    }
    fmt::print("\n{} of {} settings that were tried: the others take longer without being more exact.\n",
               t.ladder.size(), t.measured.size());
}

Tuning stored_in(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::exists(file, none))
        throw InputError(
            fmt::format("{}: there is no tuning of this scene yet; run eddy tune first", file.string()));
    try {
        return tuning_from_json(read_text_file(file), file);
    } catch (const std::runtime_error& e) {
        throw InputError(e.what());
    }
}

}  // namespace

int tune(const TuneOptions& options) {
    const Exhibit exhibit = load_exhibit(options.config).exhibit;
    const std::string& name = options.scene.empty() ? exhibit.scene : options.scene;
    const Scene scene = load_scene(name, options.set).scene;
    const std::filesystem::path folder =
        options.state_dir.empty() ? exhibit.state_dir : std::filesystem::path(options.state_dir);
    const std::filesystem::path file = tuning_file(folder, name);
    if (options.show) {
        print(stored_in(file));
        return 0;
    }
    if (scene.imposed)
        throw InputError("tune: the flow of this scene is a formula; there is nothing to tune");
    prepare_folder(options.state_dir.empty() ? "state_dir (--state-dir names another)" : "--state-dir",
                   folder);
    const std::unique_ptr<Graphics> graphics = open_headless();
    Tuner tuner(graphics->gpu, scene);
    Progress progress("tune");
    while (!tuner.done()) {
        tuner.work();
        progress.show(static_cast<double>(tuner.tried()), static_cast<double>(tuner.most_to_try()),
                      tuner.doing());
    }
    progress.finish();
    const Tuning& tuning = tuner.tuning();
    replace_text_file(file, to_json(tuning));
    print(tuning);
    const Rung& chosen = tuning.ladder.at(tuning.chosen);
    fmt::print("kept in {}; eddy run uses it from its next start on\n", file.string());
    if (chosen.step_ms <= tuning.budget_ms) return 0;
    fmt::print(stderr, "tune: not even {} keeps {:.3g} steps a second on this machine\n",
               describe(chosen.quality), tuning.target_hz);
    return 1;
}

}  // namespace eddy
