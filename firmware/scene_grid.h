#pragma once
#include "config/scene.h"

namespace eddy {

/// Cells along the longest side of the tank: how a grid is named where tanks of several proportions are compared.
int longest_side(const Scene& scene);

/// The scene with `cells` cells along the longest side of its tank. Throws InputError if the other sides would not
/// hold a whole number of cubes.
Scene with_longest_side(Scene scene, int cells);

}  // namespace eddy
