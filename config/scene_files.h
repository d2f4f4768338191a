#pragma once
#include <filesystem>
#include <vector>

#include "config/scene.h"

namespace eddy {

/// The file names that a scene holds: meshes, paths, flows. They point into the scene.
std::vector<std::filesystem::path*> files_of(Scene& scene);

}  // namespace eddy
