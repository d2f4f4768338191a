#include "firmware/verbs/run_options.h"

#include <fmt/format.h>

#include "firmware/body_schedule.h"
#include "firmware/quality/tuning.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

constexpr Seconds kShortestStep{0.001};

const std::vector<SolverPreset>& presets_of(const RunOptions& options, const Exhibit& exhibit) {
    return options.presets.empty() ? exhibit.presets : options.presets;
}

}  // namespace

const std::string& scene_name(const RunOptions& options, const Exhibit& exhibit) {
    return options.scene.empty() ? exhibit.scene : options.scene;
}

QualityControl::Setup quality_setup(const RunOptions& options, const Exhibit& exhibit, const Scene& scene) {
    QualityControl::Setup setup{
        presets_of(options, exhibit), Seconds(options.preset_s.value_or(exhibit.preset_s)), {}};
    const std::filesystem::path folder =
        options.state_dir.empty() ? exhibit.state_dir : std::filesystem::path(options.state_dir);
    // A flow that was written for one grid starts on that.
    const bool may_tune =
        options.clock == ClockChoice::Real && scene.initial.velocity_npy.empty() && !scene.imposed;
    if (may_tune && is_folder(folder)) setup.tuning = tuning_file(folder, scene_name(options, exhibit));
    return setup;
}

void require_possible(const RunOptions& options, const Exhibit& exhibit, const Scene& scene) {
    if (options.clock == ClockChoice::Stepped && !options.seconds)
        throw InputError("--clock stepped: say how long with --seconds, or it would never end");
    if (scene.solver.dt_s < kShortestStep.count())
        throw InputError(fmt::format(
            "solver.dt_s = {}: run keeps time in ticks of 1 ms; use at least 0.001 (simulate takes "
            "any)",
            scene.solver.dt_s));
    if (presets_of(options, exhibit).size() == 1)
        throw InputError("presets: one alone leaves nothing to choose; name more, or set solver.preset");
    if (options.preset_s.value_or(0.0) > 0.0 && presets_of(options, exhibit).empty())
        throw InputError(
            fmt::format("--preset-s {}: there are no presets that could change; name them with --presets",
                        *options.preset_s));
    // Each preset must be able to do what the scene asks for.
    for (const SolverPreset preset : presets_of(options, exhibit)) {
        std::vector<std::string> set = options.set;
        set.push_back(fmt::format("solver.preset=\"{}\"", to_word(preset)));
        load_scene(scene_name(options, exhibit), set);
    }
    if (options.display.value_or(exhibit.display) == DisplayChoice::Kms)
        throw InputError("--display kms: this version cannot drive a screen yet; use headless, or auto");
    BodySchedule{scene};  // reads the paths
}

}  // namespace eddy
