#include "config/exhibit.h"

#include <fmt/format.h>

#include <algorithm>

#include "cmake/embedded.h"
#include "config/printer.h"
#include "config/reader.h"
#include "config/scene.h"

namespace eddy {

extern const std::span<const EmbeddedFile> kExhibitFiles;

template <class Visitor>
void describe(Visitor& v, FalconConfig& f) {
    v.value("firmware", f.firmware,
            "path of Novint's firmware image, with which a Falcon is loaded after each time it was without "
            "power; "
            "empty: only one that runs already can be used");
    v.value("serial", f.serial, "serial string of the one to use; empty: the first that is found");
    v.value("motor_units_per_nm", f.motor_units_per_nm,
            "motor value for a newton metre at the arm: what eddy falcon calibrate finds",
            between(kLeastMotorUnitsPerNm, kMostMotorUnitsPerNm));
    v.value("keep_homing_bit", f.keep_homing_bit,
            "go on asking for the homed bits, so that lost homing is noticed");
    v.value("event_character", f.event_character,
            "its USB chip sends each reply at its last byte instead of at the next beat of its 1 ms timer");
}

template <class Visitor>
void describe(Visitor& v, GpioConfig& g) {
    v.value("button", g.button,
            "staff's button: a click starts anew, 3 s show the guide pages, 10 s shut down; line by name, as "
            "GPIO17, or as "
            "CHIP:OFFSET, as cp2112_gpio:0, where CHIP is a chip's label, name or path; empty: none");
    v.value("stop", g.stop,
            "stop input: pressed, or its line away, there is no force until a click on the button; not for "
            "conf.d");
    v.value("lamp_green", g.lamp_green,
            "green lamp; if only one of the lamps is wired it says all by the number of its blinks");
    v.value("lamp_amber", g.lamp_amber, "amber lamp");
    v.value("lamp_red", g.lamp_red, "red lamp");
    v.value("button_active_low", g.button_active_low,
            "the button joins its line to ground when it is pressed");
    v.value("stop_active_low", g.stop_active_low,
            "false: a contact that opens when the stop is pressed joins its line to ground, so that a broken "
            "wire "
            "stops, too; not for conf.d");
    v.value("lamps_active_low", g.lamps_active_low, "a lamp lights when its line is at 0 V");
}

template <class Visitor>
void describe(Visitor& v, Exhibit& e) {
    v.value("scene", e.scene, "a shipped scene by name, or the path of a scene file");
    v.value("display", e.display, "where the picture goes");
    v.value("haptics", e.haptics, "which hand moves the held body");
    v.value("force", e.force, "how the hand gets the force between two answers of the fluid");
    v.value("overlay", e.overlay, "what is written over the picture");
    v.value("presets", e.presets,
            "with more than one, the right and left buttons of the grip step through these solver presets, "
            "beginning "
            "with the first; the machine is not tuned then");
    v.value("preset_s", e.preset_s, "they also change by themselves after so long; 0: never",
            between(0, 86400));
    v.value("state_dir", e.state_dir, "what outlives a restart: calibration, tuning, flight recordings");
    v.value("run_dir", e.run_dir, "what lives as long as the program: status");
    v.value("max_force_n", e.max_force_n, "no scene makes the hand feel more", between(0, 8));
    v.table("falcon", e.falcon, "The Novint Falcon.");
    v.table("gpio", e.gpio, "Button, stop input and lamps.");
}

namespace {

/// Knows no machine: whether a line is there is for the one that runs.
void check(const GpioConfig& gpio, Findings& findings) {
    const std::pair<const char*, const std::string*> lines[] = {{"gpio.button", &gpio.button},
                                                                {"gpio.stop", &gpio.stop},
                                                                {"gpio.lamp_green", &gpio.lamp_green},
                                                                {"gpio.lamp_amber", &gpio.lamp_amber},
                                                                {"gpio.lamp_red", &gpio.lamp_red}};
    for (std::size_t i = 0; i < std::size(lines); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (const auto& [key, line] = lines[i]; !line->empty() && *line == *lines[j].second)
                findings.blame(
                    place_of(findings.origins, key), key,
                    fmt::format("line {} is that of {} already", in_quotes(*line), lines[j].first));
    if (!gpio.stop.empty() && gpio.button.empty())
        findings.blame(
            place_of(findings.origins, "gpio.stop"), "gpio.stop",
            "after a stop the force comes back by a click on the button: gpio.button must name one");
}

/// The visitor that knows what the tables are called.
struct TableNames {
    template <class T>
    void value(std::string_view, const T&, std::string_view, const Range& = {}) {}
    template <class Struct>
    void table(std::string_view key, const Struct&, std::string_view) {
        names.push_back(key);
    }
    std::vector<std::string_view> names{};
};

void check(const Exhibit& exhibit, Findings& findings) {
    const auto names = shipped_scenes();
    if (!is_scene_file(exhibit.scene) && std::find(names.begin(), names.end(), exhibit.scene) == names.end())
        findings.blame(place_of(findings.origins, "scene"), "scene",
                       in_quotes(exhibit.scene) +
                           " is neither a shipped scene nor a path; shipped, nearest first: " +
                           listed(nearest_first(exhibit.scene, names)));
    if (exhibit.preset_s > 0.0 && exhibit.presets.size() < 2)
        findings.blame(place_of(findings.origins, "preset_s"), "preset_s",
                       "there are no presets that could change; presets must name two or more");
    const auto require_absolute = [&findings](const char* key, const std::filesystem::path& path) {
        if (!path.is_absolute())
            findings.blame(place_of(findings.origins, key), key,
                           in_quotes(path.string()) + " must start with a slash");
    };
    require_absolute("state_dir", exhibit.state_dir);
    require_absolute("run_dir", exhibit.run_dir);
    if (!exhibit.falcon.firmware.empty()) require_absolute("falcon.firmware", exhibit.falcon.firmware);
    check(exhibit.gpio, findings);
}

/// The files of a configuration folder, in the order in which they apply.
struct Layers {
    std::vector<std::filesystem::path> own;       ///< exhibit.toml, if there is one: the machine's own
    std::vector<std::filesystem::path> drop_ins;  ///< conf.d: what a fleet's server may put there
};

Layers layers_in(const std::filesystem::path& folder) {
    Layers layers;
    try {
        if (std::filesystem::is_directory(folder / "conf.d")) {
            for (const auto& entry : std::filesystem::directory_iterator(folder / "conf.d")) {
                if (entry.path().extension() == ".toml") layers.drop_ins.push_back(entry.path());
            }
        }
        std::sort(layers.drop_ins.begin(), layers.drop_ins.end());
        if (std::filesystem::exists(folder / "exhibit.toml")) layers.own.push_back(folder / "exhibit.toml");
    } catch (const std::filesystem::filesystem_error& error) {
        throw ConfigError({diagnose({error.path1().string(), 0, 0}, "", error.code().message())});
    }
    return layers;
}

/// What the files say, over what the binary ships.
Exhibit read_layers(const std::vector<std::filesystem::path>& files, Findings& findings) {
    Node document = parse_toml(kExhibitFiles.front().text, std::string(kExhibitFiles.front().name));
    for (const auto& file : files) merge(document, parse_toml(read_file(file.string()), file.string()));

    Exhibit exhibit;
    read_document(document, exhibit, findings);
    return exhibit;
}

LoadedExhibit load_layers(const std::vector<std::filesystem::path>& files) {
    Findings findings;
    LoadedExhibit loaded;
    loaded.exhibit = read_layers(files, findings);
    check(loaded.exhibit, findings);
    if (!findings.diagnostics.empty()) throw ConfigError(std::move(findings.diagnostics));
    loaded.origins = std::move(findings.origins);
    return loaded;
}

}  // namespace

LoadedExhibit load_exhibit(const std::filesystem::path& folder) {
    const Layers layers = layers_in(folder);
    std::vector<std::filesystem::path> all = layers.own;
    all.insert(all.end(), layers.drop_ins.begin(), layers.drop_ins.end());
    LoadedExhibit loaded = load_layers(all);
    Findings alone;  // without the drop-ins it need not be complete
    const Exhibit own = read_layers(layers.own, alone);
    Findings findings;
    if (loaded.exhibit.max_force_n > own.max_force_n)
        findings.blame(
            place_of(loaded.origins, "max_force_n"), "max_force_n",
            fmt::format("a file in conf.d can only lower it, and without them it is {:g}; to raise "
                        "it, write it into {}",
                        own.max_force_n, (folder / "exhibit.toml").string()));
    const auto require_own = [&](const char* key, bool same) {
        if (!same)
            findings.blame(place_of(loaded.origins, key), key,
                           fmt::format("no file in conf.d can change the stop input; write it into {}",
                                       (folder / "exhibit.toml").string()));
    };
    require_own("gpio.stop", loaded.exhibit.gpio.stop == own.gpio.stop);
    require_own("gpio.stop_active_low", loaded.exhibit.gpio.stop_active_low == own.gpio.stop_active_low);
    if (!findings.diagnostics.empty()) throw ConfigError(std::move(findings.diagnostics));
    return loaded;
}

LoadedExhibit load_exhibit_file(const std::filesystem::path& file) {
    return load_layers({file});
}

bool holds_an_exhibit_table(const std::string& file) {
    TableNames tables;
    Exhibit exhibit;
    describe(tables, exhibit);
    const Node document = parse_toml(read_file(file), file);
    return std::any_of(document.children.begin(), document.children.end(), [&](const Node& entry) {
        return entry.kind == Node::Kind::Table &&
               std::find(tables.names.begin(), tables.names.end(), entry.key) != tables.names.end();
    });
}

std::string print_exhibit(Exhibit exhibit, const Origins* origins) {
    Printer printer(origins);
    describe(printer, exhibit);
    return printer.text();
}

}  // namespace eddy
