#include "config/scene_rules.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace eddy {

std::string item(const char* list, std::size_t i) {
    return fmt::format("{}.{}", list, i);
}

bool SceneRules::blamed(const std::string& key) const {
    return std::any_of(findings_.diagnostics.begin(), findings_.diagnostics.end(), [&](const Diagnostic& d) {
        return d.key == key || d.key.substr(0, key.size() + 1) == key + ".";
    });
}

void SceneRules::blame(const std::string& key, const std::string& message) {
    if (!blamed(key)) findings_.blame(place_of(findings_.origins, key), key, message);
}

void SceneRules::name_is_usable(const std::string& path, const std::string& name) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
    if (name.empty() || !letter(name.front()) || !std::all_of(name.begin(), name.end(), inner))
        blame(path + ".name", in_quotes(name) + " is no name: use letters, digits, - and _, a letter first");
    else if (!names_.insert(path.substr(0, path.find('.') + 1) + name).second)
        blame(path + ".name", in_quotes(name) + " is taken already: each must have its own name");
}

void SceneRules::reaches_the_tank(const std::string& path, const char* key, const glm::dvec3& point_m,
                                  double radius_m) {
    if (blamed(path) || blamed("tank.size_m")) return;
    const glm::dvec3 size = scene.tank.size_m;
    const glm::dvec3 nearest = glm::clamp(point_m, glm::dvec3(0.0), size);
    if (glm::distance(point_m, nearest) <= radius_m) return;
    blame(path + "." + key,
          fmt::format("is outside the tank, which reaches from [0, 0, 0] to {}", to_toml(size)));
}

void SceneRules::file_exists(const std::string& key, const std::filesystem::path& file) {
    if (std::error_code error; !file.empty() && !std::filesystem::is_regular_file(file, error))
        blame(key, fmt::format("there is no file {}", in_quotes(file.string())));
}

}  // namespace eddy
