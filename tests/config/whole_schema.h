#pragma once
#include <string>
#include <vector>

#include "config/scene.h"

namespace eddy {

/// Reads a scene by all rules of the schema, whether or not this version of the solver can do what it says.
/// File names start from the current folder. Throws ConfigError, in which the file is called s.toml.
LoadedScene read_whole(const std::string& text);

/// What is wrong with it by those rules, one line each.
std::vector<std::string> faults_of(const std::string& text);

}  // namespace eddy
