#pragma once
#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "config/reader.h"
#include "config/scene.h"

namespace eddy {

/// "body.0"
std::string item(const char* list, std::size_t i);

/// What the checks of a scene have in common: what was written, what is blamed already, how to blame.
class SceneRules {
  public:
    SceneRules(const Scene& checked, Findings& findings) : scene(checked), findings_(findings) {}

    const Scene& scene;

    bool given(const std::string& key) const { return findings_.origins.contains(key); }

    /// Whether the key, or anything inside it, is known to be wrong already.
    bool blamed(const std::string& key) const;

    /// Stays silent about what is blamed already.
    void blame(const std::string& key, const std::string& message);

    /// Names head columns of series.csv and are steps of override paths: plain, and used once in their list.
    void name_is_usable(const std::string& path, const std::string& name);

    /// Blames path.key if a ball around the point touches no fluid: it would silently do nothing.
    void reaches_the_tank(const std::string& path, const char* key, const glm::dvec3& point_m,
                          double radius_m);

    /// Blames the key unless the file is there; `file` may be empty.
    void file_exists(const std::string& key, const std::filesystem::path& file);

  private:
    Findings& findings_;
    std::set<std::string> names_;
};

// The rules, by topic.
void check_walls(SceneRules& rules);
void check_flow(SceneRules& rules);
void check_bodies(SceneRules& rules);
void check_outputs(SceneRules& rules);

}  // namespace eddy
