#include "config/scene.h"

#include <algorithm>

#include "cmake/embedded.h"
#include "config/exhibit.h"
#include "config/override.h"
#include "config/printer.h"
#include "config/reference.h"
#include "config/scene_check.h"
#include "config/scene_schema.h"

namespace eddy {

extern const std::span<const EmbeddedFile> kSceneFiles;

namespace {

constexpr std::string_view kReferenceHead = R"(# Scenes

A scene is a TOML file. What it does not name is as the tables below say; an effect that it does not name costs nothing. This is
a whole one:

```toml
title = "A ball in smoke"

[tank]
size_m = [0.16, 0.16, 0.16]
cells = [48, 48, 48]

[fluid]
density_kg_m3 = 1.2             # air

[smoke]

[[source]]                      # [[ ]]: there may be several
centre_m = [0.08, 0.02, 0.08]
radius_m = 0.012
smoke_per_s = 20.0
velocity_m_s = [0.0, 0.3, 0.0]

[[body]]
shape = "sphere"
radius_m = 0.013
motion = "held"                 # by the visitor's hand

[haptics]
gain = 10000.0                  # air on a small ball is far below what a hand can feel
```

`eddy check-config FILE` says what is wrong with one, and where; `eddy run --scene FILE` shows it; `eddy simulate FILE --plan`
tells which passes and textures it calls for. `eddy print-config jet` prints a shipped one with every value that stands in it.

)";

constexpr std::string_view kScenesFolder = "config/scenes/", kValidation = "validation/";

// "jet" for config/scenes/jet.toml, "validation/A1" for config/scenes/validation/A1.toml.
std::string_view scene_name(const EmbeddedFile& file) {
    const std::string_view name = std::string_view(file.name).substr(kScenesFolder.size());
    return name.substr(0, name.rfind('.'));
}

std::vector<std::string_view> sorted_names(bool of_validation) {
    std::vector<std::string_view> names;
    for (const EmbeddedFile& file : kSceneFiles)
        if (scene_name(file).starts_with(kValidation) == of_validation) names.push_back(scene_name(file));
    std::sort(names.begin(), names.end());
    return names;
}

LoadedScene read_scene_in(const std::filesystem::path& folder, std::string_view text, const std::string& file,
                          std::span<const std::string> overrides) {
    Node document = parse_toml(text, file);
    Findings findings;
    int number = 0;
    for (const std::string& text_of_one : overrides)
        apply_override(document, text_of_one, ++number, findings.diagnostics);

    LoadedScene loaded;
    read_document(document, loaded.scene, findings);
    resolve(loaded.scene, findings.origins, folder);
    check(loaded.scene, findings);
    refuse_what_is_not_in_this_version(loaded.scene, findings);
    if (!findings.diagnostics.empty()) throw ConfigError(std::move(findings.diagnostics));
    loaded.origins = std::move(findings.origins);
    return loaded;
}

}  // namespace

std::vector<std::string_view> shipped_scenes() {
    return sorted_names(false);
}

std::vector<std::string_view> validation_scenes() {
    return sorted_names(true);
}

bool is_scene_file(std::string_view path_or_name) {
    if (path_or_name.ends_with(".toml")) return true;
    return !path_or_name.starts_with(kValidation) && path_or_name.find('/') != std::string_view::npos;
}

LoadedScene load_scene(const std::string& path_or_name, std::span<const std::string> overrides) {
    if (is_scene_file(path_or_name)) return read_scene(read_file(path_or_name), path_or_name, overrides);
    for (const EmbeddedFile& file : kSceneFiles) {
        if (scene_name(file) == path_or_name)
            return read_scene_in(std::filesystem::current_path(), file.text, std::string(file.name),
                                 overrides);
    }
    const bool of_validation = path_or_name.starts_with(kValidation);
    const std::string choice = listed(nearest_first(path_or_name, sorted_names(of_validation)));
    throw ConfigError({diagnose({path_or_name, 0, 0}, "",
                                "no shipped scene has this name; shipped, nearest first: " + choice +
                                    "; a scene file is named with a slash or with .toml at its end")});
}

LoadedScene read_scene(std::string_view text, const std::string& file,
                       std::span<const std::string> overrides) {
    return read_scene_in(std::filesystem::path(file).parent_path(), text, file, overrides);
}

bool holds_a_scene(const std::string& file) {
    const Node document = parse_toml(read_file(file), file);
    return std::any_of(document.children.begin(), document.children.end(), [](const Node& entry) {
        if (entry.kind == Node::Kind::Table) return !is_exhibit_table(entry.key);
        if (entry.kind == Node::Kind::List) return !is_exhibit_key(entry.key);
        return entry.key == "title" || entry.key == "description";
    });
}

std::vector<glm::dvec3> Scene::Probe::places_m() const {
    if (point_m) return {*point_m};
    std::vector<glm::dvec3> places;
    for (int i = 0; i < *points; ++i)
        places.push_back(glm::mix(*from_m, *to_m, static_cast<double>(i) / (*points - 1)));
    return places;
}

std::string print_scene(Scene scene, const Origins* origins) {
    Printer printer(origins);
    describe(printer, scene);
    return printer.text();
}

std::string schema_reference() {
    Reference reference;
    Scene scene;
    describe(reference, scene);
    return std::string(kReferenceHead) + reference.text() + "\n## Formulas\n\n" + formula_guide() + "\n";
}

}  // namespace eddy
