#include "firmware/verbs/run_options.h"

#include <fmt/format.h>

#include "firmware/body_schedule.h"
#include "firmware/destination.h"
#include "firmware/quality/tuning.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

constexpr Seconds kShortestStep{0.001};

}  // namespace

Exhibit with_options(Exhibit exhibit, const RunOptions& options) {
    if (!options.scene.empty()) exhibit.scene = options.scene;
    if (options.display) exhibit.display = *options.display;
    if (options.haptics) exhibit.haptics = *options.haptics;
    if (options.overlay) exhibit.overlay = *options.overlay;
    if (!options.presets.empty()) exhibit.presets = options.presets;
    if (options.preset_s) exhibit.preset_s = *options.preset_s;
    if (!options.run_dir.empty()) exhibit.run_dir = options.run_dir;
    if (!options.state_dir.empty()) exhibit.state_dir = options.state_dir;
    return exhibit;
}

Act::Setup act_setup(const RunOptions& options, const Exhibit& exhibit, const Scene& scene, bool has_picture,
                     bool has_hand) {
    Act::Setup setup{.quality = {exhibit.presets, Seconds(exhibit.preset_s), {}},
                     .has_picture = has_picture,
                     .has_hand = has_hand,
                     .shows_cost = exhibit.overlay == OverlayChoice::Cost};
    // A flow that was written for one grid starts on that.
    const bool may_tune =
        options.clock == ClockChoice::Real && scene.initial.velocity_npy.empty() && !scene.imposed;
    if (may_tune && is_folder(exhibit.state_dir))
        setup.quality.tuning = tuning_file(exhibit.state_dir, exhibit.scene);
    return setup;
}

HapticLoopSettings loop_settings(const Exhibit& exhibit) {
    HapticLoopSettings settings;
    settings.law = exhibit.force == ForceChoice::Filter ? ForceLaw::Filter : ForceLaw::Model;
    return settings;
}

std::filesystem::path flights_folder(const Exhibit& exhibit) {
    return is_folder(exhibit.state_dir) ? exhibit.state_dir / "flights" : std::filesystem::path();
}

void prepare_folders(const RunOptions& options) {
    if (!options.run_dir.empty()) prepare_folder("--run-dir", options.run_dir);
    if (!options.state_dir.empty()) prepare_folder("--state-dir", options.state_dir);
}

void require_possible(const RunOptions& options, const Exhibit& exhibit, const Scene& scene) {
    if (options.clock == ClockChoice::Stepped && !options.seconds)
        throw InputError("--clock stepped: say how long with --seconds, or it would never end");
    if (scene.solver.dt_s < kShortestStep.count())
        throw InputError(fmt::format(
            "solver.dt_s = {}: run keeps time in ticks of 1 ms; use at least 0.001 (simulate takes "
            "any)",
            scene.solver.dt_s));
    if (exhibit.presets.size() == 1)
        throw InputError("presets: one alone leaves nothing to choose; name more, or set solver.preset");
    if (options.preset_s.value_or(0.0) > 0.0 && exhibit.presets.empty())
        throw InputError(
            fmt::format("--preset-s {}: there are no presets that could change; name them with --presets",
                        *options.preset_s));
    BodySchedule{scene};  // reads the paths
}

}  // namespace eddy
