#pragma once
#include <compare>
#include <string>

#include "config/scene.h"

namespace eddy {

/// How exactly the fluid of a scene is computed. All else of the scene stays as it is.
struct Quality {
    SolverPreset preset = SolverPreset::Fast;
    int cells = 64;      ///< along the longest side of the tank
    int iterations = 2;  ///< of the pressure in a step: multigrid cycles, or Jacobi sweeps of yang2009
    auto operator<=>(const Quality&) const = default;
};

/// How often a preset iterates if the scene does not say.
int usual_iterations(SolverPreset preset);
/// Throws std::invalid_argument if no preset has this name.
SolverPreset preset_named(const std::string& name);

/// That of the scene as it is written.
Quality quality_of(const Scene& scene);
/// The scene computed so. Throws InputError if its tank cannot be divided into that many cells.
Scene with_quality(Scene scene, const Quality& quality);
/// As another preset computes it, on the same grid.
Quality with_preset(Quality quality, SolverPreset preset);
/// "fast 64^3, 2 cycles"
std::string describe(const Quality& quality);

}  // namespace eddy
