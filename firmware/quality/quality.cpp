#include "firmware/quality/quality.h"

#include <fmt/format.h>

#include <stdexcept>

#include "firmware/scene_grid.h"

namespace eddy {

int usual_iterations(SolverPreset preset) {
    switch (preset) {
        case SolverPreset::Fast:
            return 2;
        case SolverPreset::Precise:
            return 3;
        case SolverPreset::Yang2009:
            return 40;
    }
    throw std::logic_error("a preset without iterations");
}

SolverPreset preset_named(const std::string& name) {
    if (const auto preset = from_word<SolverPreset>(name)) return *preset;
    throw std::invalid_argument(fmt::format("there is no preset named '{}'", name));
}

Quality quality_of(const Scene& scene) {
    const Scene::Solver& solver = scene.solver;
    const std::optional<int>& written =
        solver.preset == SolverPreset::Yang2009 ? solver.jacobi_sweeps : solver.cycles;
    return {solver.preset, longest_side(scene), written.value_or(usual_iterations(solver.preset))};
}

Scene with_quality(Scene scene, const Quality& quality) {
    if (quality == quality_of(scene)) return scene;
    scene.initial.velocity_npy
        .clear();  // on the cells it was written for; a fluid takes its flow over from another
    if (quality.cells != longest_side(scene)) scene = with_longest_side(std::move(scene), quality.cells);
    Scene::Solver& solver = scene.solver;
    // What was written for one preset does not hold for another.
    if (quality.preset != solver.preset) {
        const double dt_s = solver.dt_s;
        solver = {};
        solver.dt_s = dt_s;
        solver.preset = quality.preset;
    }
    (quality.preset == SolverPreset::Yang2009 ? solver.jacobi_sweeps : solver.cycles) = quality.iterations;
    return scene;
}

Quality with_preset(Quality quality, SolverPreset preset) {
    return {preset, quality.cells, usual_iterations(preset)};
}

std::string describe(const Quality& quality) {
    const char* what = quality.preset == SolverPreset::Yang2009 ? "sweep" : "cycle";
    return fmt::format("{} {}^3, {} {}{}", to_word(quality.preset), quality.cells, quality.iterations, what,
                       quality.iterations == 1 ? "" : "s");
}

}  // namespace eddy
