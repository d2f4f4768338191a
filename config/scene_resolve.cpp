#include <fmt/format.h>

#include "config/override.h"
#include "config/scene_check.h"
#include "config/scene_rules.h"

namespace eddy {
namespace {

class Resolution {
  public:
    Resolution(const Origins& origins, const std::filesystem::path& folder)
        : origins_(origins), folder_(folder) {}

    bool given(const std::string& key) const { return origins_.contains(key); }

    void name(const char* list, std::size_t i, std::string& field) const {
        if (!given(item(list, i) + ".name")) field = fmt::format("{}{}", list, i + 1);
    }

    void file(const std::string& key, std::filesystem::path& field) const {
        if (field.empty()) return;
        const bool overridden = place_of(origins_, key).file == kOverrideFile;
        const auto start = std::filesystem::current_path() / (overridden ? "" : folder_);
        field = (start / field).lexically_normal();
    }

  private:
    const Origins& origins_;
    const std::filesystem::path& folder_;
};

}  // namespace

void resolve(Scene& scene, const Origins& origins, const std::filesystem::path& folder) {
    const Resolution resolution(origins, folder);
    if (!resolution.given("haptics.centre_m")) scene.haptics.centre_m = 0.5 * scene.tank.size_m;
    for (std::size_t i = 0; i < scene.sources.size(); ++i)
        resolution.name("source", i, scene.sources[i].name);
    for (std::size_t i = 0; i < scene.probes.size(); ++i) resolution.name("probe", i, scene.probes[i].name);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        Scene::Body& body = scene.bodies[i];
        const std::string path = item("body", i);
        resolution.name("body", i, body.name);
        if (!resolution.given(path + ".centre_m")) body.centre_m = scene.haptics.centre_m;
        resolution.file(path + ".path_csv", body.path_csv);
        resolution.file(path + ".file", body.file);
    }
    resolution.file("initial.velocity_npy", scene.initial.velocity_npy);
}

}  // namespace eddy
