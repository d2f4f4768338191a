#pragma once
#include <string_view>

#include "config/scene.h"

namespace eddy {

/// Cells along the longest side of the tank: how a grid is named where tanks of several proportions are compared.
int longest_side(const Scene& scene);

/// How a complaint about a grid begins: with what asked for it.
inline constexpr std::string_view kAnyGrid = "a grid of", kGridOption = "--grid",
                                  kNoGridOption = "without --grid, a grid of";

/// The scene with `cells` cells along the longest side of its tank. Throws InputError, "--grid 25: ...", if the other sides
/// would not hold a whole number of cubes.
Scene with_longest_side(Scene scene, int cells, std::string_view asked_by = kAnyGrid);

}  // namespace eddy
