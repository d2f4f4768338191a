#include <fmt/format.h>

#include "config/document.h"
#include "config/exhibit.h"
#include "config/scene.h"
#include "firmware/body_schedule.h"
#include "firmware/exhibit/config_set.h"
#include "firmware/exhibit/events.h"
#include "firmware/fluid_setup.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

namespace {

/// Reads the meshes, the paths and the flow at the start.
void check_files_of(const Scene& scene) {
    BodySchedule{scene};
    fluid_setup(scene);
}

}  // namespace

int check_config(const std::string& file) {
    if (holds_a_scene(file)) {
        const Scene scene = load_scene(is_scene_file(file) ? file : "./" + file).scene;
        check_files_of(scene);
        fmt::print("{}: a good scene\n", file);
    } else {
        load_exhibit_file(file);
        fmt::print("{}: good exhibit settings\n", file);
    }
    return 0;
}

int check_config_folder(const std::string& folder) {
    const ConfigSet set = read_config_set(folder, {});
    if (set.files.exhibit.none())
        throw InputError(fmt::format("{}: there is neither an exhibit.toml nor a conf.d/*.toml", folder));
    if (!set.good()) throw ConfigError(set.diagnostics);
    check_files_of(set.scene.scene);
    fmt::print("{}: good exhibit settings, hash {}\n", folder, set.hash);
    return 0;
}

int print_config(const std::string& folder, const std::string& scene, const std::vector<std::string>& set,
                 bool origin) {
    if (scene.empty()) {
        if (!set.empty())
            throw InputError(
                "--set: name the scene it changes, as in print-config jet --set solver.dt_s=0.01");
        const LoadedExhibit loaded = load_exhibit(folder);
        fmt::print("{}", print_exhibit(loaded.exhibit, origin ? &loaded.origins : nullptr));
    } else {
        const LoadedScene loaded = load_scene(scene, set);
        fmt::print("{}", print_scene(loaded.scene, origin ? &loaded.origins : nullptr));
    }
    return 0;
}

int print_log_reference() {
    fmt::print("{}", log_reference());
    return 0;
}

int print_schema() {
    fmt::print("{}", schema_reference());
    return 0;
}

int print_exhibit_keys() {
    fmt::print("{}", exhibit_reference());
    return 0;
}

int print_exhibit_schema() {
    fmt::print("{}", exhibit_schema());
    return 0;
}

}  // namespace eddy
