#include <fmt/format.h>

#include "config/document.h"
#include "config/exhibit.h"
#include "config/scene.h"
#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

int check_config(const std::string& file) {
    if (holds_a_scene(file)) {
        const Scene scene = load_scene(is_scene_file(file) ? file : "./" + file).scene;
        BodySchedule{scene};  // reads the paths
        fluid_setup(scene);   // reads the meshes and the flow at the start
        fmt::print("{}: a good scene\n", file);
    } else {
        load_exhibit_file(file);
        fmt::print("{}: good exhibit settings\n", file);
    }
    return 0;
}

int print_config(const std::string& scene, const std::vector<std::string>& set, bool origin) {
    if (scene.empty()) {
        if (!set.empty())
            throw InputError(
                "--set: name the scene it changes, as in print-config jet --set solver.dt_s=0.01");
        const LoadedExhibit loaded = load_exhibit();
        fmt::print("{}", print_exhibit(loaded.exhibit, origin ? &loaded.origins : nullptr));
    } else {
        const LoadedScene loaded = load_scene(scene, set);
        fmt::print("{}", print_scene(loaded.scene, origin ? &loaded.origins : nullptr));
    }
    return 0;
}

int print_schema() {
    fmt::print("{}", schema_reference());
    return 0;
}

}  // namespace eddy
