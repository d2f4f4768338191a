#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "config/scene.h"

namespace eddy {

/// A file that a scene names: a mesh, a path, a flow.
struct SceneFile {
    std::string key;  ///< "body.0.file", as --set takes it
    std::filesystem::path path;
};
std::vector<SceneFile> files_of(Scene scene);

}  // namespace eddy
