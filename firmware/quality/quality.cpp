#include "firmware/quality/quality.h"

#include "firmware/accuracy/sweep/setting.h"
#include "firmware/scene_grid.h"

namespace eddy {

using accuracy::sweep::usual_iterations;

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
    return describe(accuracy::sweep::Setting{quality.preset, quality.cells, quality.iterations});
}

}  // namespace eddy
