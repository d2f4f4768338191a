#include "firmware/exhibit/config_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/scene_files.h"
#include "config/sha256.h"

namespace eddy {
namespace {

void append(std::vector<Diagnostic>& all, const std::vector<Diagnostic>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

std::string hash_of(const ConfigFiles& files) {
    std::string all;
    const auto add = [&all](const std::string& name, const std::string& text) {
        all += fmt::format("{}\n{}\n", name, text.size());
        all += text;
    };
    for (const auto* layer : {&files.exhibit.own, &files.exhibit.drop_ins, &files.exhibit.sums})
        for (const WrittenFile& file : *layer) {
            const std::filesystem::path name = file.path.lexically_relative(files.exhibit.folder);
            add((name.empty() ? file.path : name).string(), file.text);
        }
    for (const auto* more : {&files.scene, &files.refers})
        for (const WrittenFile& file : *more) add(file.path.string(), file.text);
    // What could not be read is no other configuration until it is something else that is wrong.
    for (const Diagnostic& diagnostic : files.exhibit.diagnostics) add("", to_string(diagnostic));
    return sha256(all);
}

/// Which scene, for one preset after the other in place of its own.
LoadedScene read_the_scene(const ConfigSet& set, const std::string& name,
                           const std::vector<std::string>& orders) {
    const std::vector<WrittenFile>& read = set.files.scene;
    return !read.empty() && read.front().path == name ? read_scene(read.front().text, name, orders)
                                                      : load_scene(name, orders);
}

void check_presets(ConfigSet& set, const std::string& name, const SceneOrders& orders) {
    const bool ordered = !orders.presets.empty();
    for (const SolverPreset preset : ordered ? orders.presets : set.exhibit.exhibit.presets) {
        std::vector<std::string> with = orders.set;
        with.push_back(fmt::format("solver.preset=\"{}\"", to_word(preset)));
        try {
            read_the_scene(set, name, with);
        } catch (const ConfigError& error) {
            for (const Diagnostic& d : error.diagnostics())
                set.diagnostics.push_back(diagnose(
                    ordered ? Place{"--presets", 0, 0} : place_of(set.exhibit.origins, "presets"), "presets",
                    fmt::format("{} cannot do the scene: {}: {}", to_word(preset), d.key, d.message)));
        }
    }
}

std::string scene_name(const ConfigSet& set, const SceneOrders& orders) {
    return orders.scene.empty() ? set.exhibit.exhibit.scene : orders.scene;
}

/// Whether the scene's name is worth following.
bool names_a_scene(const ConfigSet& set, const SceneOrders& orders) {
    return !orders.scene.empty() || std::none_of(set.diagnostics.begin(), set.diagnostics.end(),
                                                 [](const Diagnostic& d) { return d.key == "scene"; });
}

void read_exhibit_into(ConfigSet& set) {
    ExhibitReading reading = read_exhibit(set.files.exhibit);
    set.exhibit = std::move(reading.loaded);
    set.diagnostics = std::move(reading.diagnostics);
}

void read_scene_into(ConfigSet& set, const SceneOrders& orders) {
    const std::string name = scene_name(set, orders);
    set.scene = read_the_scene(set, name, orders.set);
    check_presets(set, name, orders);
}

}  // namespace

ConfigSet read_config_set(const std::filesystem::path& folder, const SceneOrders& orders) {
    ConfigSet set;
    set.files.exhibit = read_exhibit_files(folder);
    read_exhibit_into(set);
    if (names_a_scene(set, orders)) {
        try {
            const std::string name = scene_name(set, orders);
            if (is_scene_file(name)) read_written_file(name, Links::Follow, set.files.scene);
            read_scene_into(set, orders);
            std::size_t room = kMostReferredBytes;
            for (const SceneFile& file : files_of(set.scene.scene)) {
                set.files.refers.push_back({file.path, read_whole_file(file.path, Links::Follow, room)});
                set.files.keys.push_back(file.key);
                room -= set.files.refers.back().text.size();
            }
        } catch (const ConfigError& error) {
            append(set.diagnostics, error.diagnostics());
        }
    }
    set.hash = set.files.exhibit.none() ? kFactoryHash : hash_of(set.files);
    return set;
}

ConfigSet config_set_of(const ConfigFiles& files, const SceneOrders& orders,
                        const std::vector<std::filesystem::path>& refers) {
    ConfigSet set;
    set.files = files;
    set.hash = hash_of(files);
    read_exhibit_into(set);
    if (!names_a_scene(set, orders)) return set;
    SceneOrders moved = orders;
    if (orders.scene.empty()) {
        moved.set.clear();
        for (std::size_t i = 0; i < refers.size(); ++i)
            moved.set.push_back(fmt::format("{}={}", files.keys[i], in_quotes(refers[i].string())));
        moved.set.insert(moved.set.end(), orders.set.begin(), orders.set.end());
    }
    try {
        read_scene_into(set, moved);
    } catch (const ConfigError& error) {
        append(set.diagnostics, error.diagnostics());
    }
    return set;
}

ConfigSet factory_set(const SceneOrders& orders) {
    ConfigSet set;
    read_exhibit_into(set);
    set.hash = kFactoryHash;
    try {
        if (const std::string name = scene_name(set, orders); is_scene_file(name))
            read_written_file(name, Links::Follow, set.files.scene);
        read_scene_into(set, orders);
    } catch (const ConfigError& error) {
        append(set.diagnostics, error.diagnostics());
    }
    return set;
}

}  // namespace eddy
