#pragma once
#include <filesystem>

#include "config/reader.h"
#include "config/scene.h"

namespace eddy {

/// Fills in the defaults that follow from other values, and makes file names absolute; `folder` is the scene
/// file's.
void resolve(Scene& scene, const Origins& origins, const std::filesystem::path& folder);

/// Blames what no key shows alone: cells that are not cubes, keys that need or exclude each other, names used
/// twice, things outside the tank. A rule about a key that is blamed already stays silent.
void check(const Scene& scene, Findings& findings);

/// Blames what a scene may say but the solver of this version does not do.
void refuse_what_is_not_in_this_version(const Scene& scene, Findings& findings);

}  // namespace eddy
