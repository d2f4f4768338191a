#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "config/scene.h"

namespace eddy::stability {

/// A scene that the seed decides, the same on every machine: a tank of 16^3 cells with any fluid, walls, effects, jets and bodies
/// that a scene file may ask for. Bodies may stand in walls and in each other, and move as no hand does; files (meshes, paths,
/// fields) and what only measures (probes, outputs) are left out.
Scene random_scene(std::uint64_t seed);

/// What the scene is without one of its parts, for each part that it could be without: a body, a jet, an effect, a motion, a
/// wall that is not plain. Only scenes that a file may hold.
std::vector<Scene> simpler_scenes(const Scene& scene);

/// As simple as it gets while `fails` says so; `fails(scene)` is true to begin with. Parts are taken out one after another until
/// none can be spared.
Scene shrink(Scene scene, const std::function<bool(const Scene&)>& fails);

}  // namespace eddy::stability
