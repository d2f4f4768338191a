#include "config/exhibit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "cmake/embedded.h"
#include "config/exhibit_keys.h"
#include "config/json_schema.h"
#include "config/printer.h"
#include "config/reader.h"
#include "config/reference.h"
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
void describe(Visitor& v, HoursConfig& h) {
    constexpr std::string_view kDay =
        "when it is open: ranges as 09:00-12:00, 13:00-17:00, or closed; empty: all day";
    v.value("monday", h.monday, kDay);
    v.value("tuesday", h.tuesday, kDay);
    v.value("wednesday", h.wednesday, kDay);
    v.value("thursday", h.thursday, kDay);
    v.value("friday", h.friday, kDay);
    v.value("saturday", h.saturday, kDay);
    v.value("sunday", h.sunday, kDay);
    v.value("exceptions", h.exceptions,
            "days that are not like others, as 2026-12-24 09:00-12:00; 2026-12-25 closed");
}

template <class Visitor>
void describe(Visitor& v, UnattendedConfig& u) {
    v.value("idle_after_s", u.idle_after_s,
            "a handle that nobody touches for so long: the visitor is gone, and the scene begins anew; ten "
            "seconds before, the screen says so",
            between(kLeastIdle_s, kMostIdle_s));
    v.value("metrics_file", u.metrics_file,
            "figures for Prometheus' node_exporter are written here; empty: eddy.prom in run_dir");
}

template <class Visitor>
void describe(Visitor& v, ScreenConfig& s) {
    v.value("connector", s.connector,
            "plug of the screen, as eddy screen names it (HDMI-A-1, or card1-HDMI-A-1); empty: the screen of "
            "last time, else the "
            "first that is connected");
    v.value("mode", s.mode,
            "1920x1080@60, or 1920x1080 for the rate nearest to 60; empty: what the monitor prefers");
    v.value("max_pixels", s.max_pixels,
            "the picture is drawn no larger, and scaled up to the screen; a processor that draws in software "
            "needs a "
            "tenth of what a GPU can do; 0: as large as the screen",
            between(0, 33177600));
}

template <class Visitor>
void describe(Visitor& v, Exhibit& e) {
    v.takes_effect(TakesEffect::Scene);
    v.value("scene", e.scene,
            "a shipped scene by name, or the path of a scene file; relative to this folder");
    v.takes_effect(TakesEffect::Process);
    v.value("display", e.display, "where the picture goes");
    v.value("haptics", e.haptics, "which hand moves the held body");
    v.value("force", e.force, "how the hand gets the force between two answers of the fluid");
    v.takes_effect(TakesEffect::Live);
    v.value("overlay", e.overlay, "what is written over the picture");
    v.takes_effect(TakesEffect::Scene);
    v.value("presets", e.presets,
            "with more than one, the right and left buttons of the grip step through these solver presets, "
            "beginning "
            "with the first; the machine is not tuned then");
    v.value("preset_s", e.preset_s, "they also change by themselves after so long; 0: never",
            between(0, 86400));
    v.takes_effect(TakesEffect::Process);
    v.value("state_dir", e.state_dir, "what outlives a restart: calibration, tuning, flight recordings");
    v.value("run_dir", e.run_dir, "what lives as long as the program: status");
    v.takes_effect(TakesEffect::Live);
    v.value("max_force_n", e.max_force_n,
            "no scene makes the hand feel more; a file in conf.d can only lower it", between(0, 8));
    v.takes_effect(TakesEffect::Process);
    v.table("falcon", e.falcon, "The Novint Falcon.");
    v.table("gpio", e.gpio, "Button, stop input and lamps.");
    v.table("screen", e.screen, "The screen.");
    v.takes_effect(TakesEffect::Live);
    v.table("hours", e.hours,
            "Opening hours, by the clock on the wall; not before the machine's clock is synchronised.");
    v.table("unattended", e.unattended, "What goes on without anybody of the house.");
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

/// 1920x1080, or 1920x1080@59.94.
bool is_mode(const std::string& text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto number = [&](auto value, double most) {
        const auto [next, error] = std::from_chars(at, end, value);
        at = next;
        return error == std::errc() && value > 0 && value <= most;
    };
    const auto letter = [&](char c) { return at != end && *at++ == c; };
    if (!number(0, 65535) || !letter('x') || !number(0, 65535)) return false;
    return at == end || (letter('@') && number(0.0, 1000.0) && at == end);
}

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
    for (auto preset = exhibit.presets.begin(); preset != exhibit.presets.end(); ++preset)
        if (std::find(exhibit.presets.begin(), preset, *preset) != preset) {
            findings.blame(place_of(findings.origins, "presets"), "presets",
                           in_quotes(std::string(to_word(*preset))) + " is there twice");
            break;
        }
    const auto require_absolute = [&findings](const char* key, const std::filesystem::path& path) {
        if (!path.is_absolute())
            findings.blame(place_of(findings.origins, key), key,
                           in_quotes(path.string()) + " must start with a slash");
    };
    require_absolute("state_dir", exhibit.state_dir);
    require_absolute("run_dir", exhibit.run_dir);
    if (!exhibit.unattended.metrics_file.empty())
        require_absolute("unattended.metrics_file", exhibit.unattended.metrics_file);
    const auto require_hours = [&findings](const std::string& day, const std::string& text, auto parse) {
        try {
            parse(text);
        } catch (const std::invalid_argument& error) {
            findings.blame(place_of(findings.origins, "hours." + day), "hours." + day, error.what());
        }
    };
    const HoursConfig& h = exhibit.hours;
    const std::pair<const char*, const std::string*> days[] = {
        {"monday", &h.monday},     {"tuesday", &h.tuesday}, {"wednesday", &h.wednesday},
        {"thursday", &h.thursday}, {"friday", &h.friday},   {"saturday", &h.saturday},
        {"sunday", &h.sunday}};
    for (const auto& [day, text] : days) require_hours(day, *text, parse_day);
    require_hours("exceptions", h.exceptions, parse_exceptions);
    if (!exhibit.falcon.firmware.empty()) require_absolute("falcon.firmware", exhibit.falcon.firmware);
    if (const std::string& mode = exhibit.screen.mode; !mode.empty() && !is_mode(mode))
        findings.blame(place_of(findings.origins, "screen.mode"), "screen.mode",
                       in_quotes(mode) + " must be written like 1920x1080@60 or 1920x1080");
    check(exhibit.gpio, findings);
}

/// The files that match, sorted by name. A folder that is not there has none.
std::vector<std::filesystem::path> toml_files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::is_directory(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::filesystem::path name = entry.path().filename();
        if (name.extension() == ".toml" && !name.string().starts_with('.')) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void read_one(const std::filesystem::path& path, Links links, std::vector<WrittenFile>& layer,
              ExhibitFiles& files) {
    std::vector<WrittenFile> read;
    try {
        read_written_file(path, links, read);
    } catch (const ConfigError& error) {
        const auto& all = error.diagnostics();
        files.diagnostics.insert(files.diagnostics.end(), all.begin(), all.end());
    }
    for (std::size_t i = 0; i < read.size(); ++i) (i == 0 ? layer : files.sums).push_back(std::move(read[i]));
}

/// A file's TOML over `document`; what is wrong with the file by itself is blamed.
void merge_layer(const WrittenFile& file, Node& document, Findings& findings) {
    try {
        const Node layer = parse_toml(file.text, file.path.string());
        Exhibit alone;
        Findings of_layer;
        read_document(layer, alone, of_layer);
        auto& blamed = of_layer.diagnostics;
        findings.diagnostics.insert(findings.diagnostics.end(), blamed.begin(), blamed.end());
        merge(document, layer);
    } catch (const ConfigError& error) {
        const auto& all = error.diagnostics();
        findings.diagnostics.insert(findings.diagnostics.end(), all.begin(), all.end());
    }
}

LoadedExhibit read_merged(const Node& document) {
    LoadedExhibit loaded;
    Findings seen_already;  // by merge_layer()
    read_document(document, loaded.exhibit, seen_already);
    loaded.origins = std::move(seen_already.origins);
    return loaded;
}

/// What a fleet's server may not do from afar.
void check_drop_ins(const Exhibit& own, const ExhibitReading& all, const ExhibitFiles& files,
                    Findings& findings) {
    const Exhibit& exhibit = all.loaded.exhibit;
    const std::string file = (files.folder / "exhibit.toml").string();
    const auto refuse = [&](const char* key, const std::string& why) {
        findings.blame(place_of(all.loaded.origins, key), key, why);
    };
    if (exhibit.max_force_n > own.max_force_n)
        refuse("max_force_n", fmt::format("a file in conf.d can only lower it, and without them it is {:g}; "
                                          "to raise it, write it into {}",
                                          own.max_force_n, file));
    const std::string stop = "no file in conf.d can change the stop input; write it into " + file;
    if (exhibit.gpio.stop != own.gpio.stop) refuse("gpio.stop", stop);
    if (exhibit.gpio.stop_active_low != own.gpio.stop_active_low) refuse("gpio.stop_active_low", stop);
}

ExhibitReading load_or_throw(const ExhibitFiles& files) {
    ExhibitReading reading = read_exhibit(files);
    if (!reading.diagnostics.empty()) throw ConfigError(std::move(reading.diagnostics));
    return reading;
}

}  // namespace

ExhibitFiles read_exhibit_files(const std::filesystem::path& folder) {
    ExhibitFiles files;
    try {
        files.folder = std::filesystem::absolute(folder).lexically_normal();
        if (std::filesystem::exists(std::filesystem::symlink_status(folder / "exhibit.toml")))
            read_one(folder / "exhibit.toml", Links::Follow, files.own, files);
        for (const auto& file : toml_files_in(folder / "conf.d"))
            read_one(file, Links::Refuse, files.drop_ins, files);
    } catch (const std::filesystem::filesystem_error& error) {
        files.diagnostics.push_back(diagnose({error.path1().string(), 0, 0}, "", error.code().message()));
    }
    return files;
}

ExhibitReading read_exhibit(const ExhibitFiles& files) {
    Findings findings;
    findings.diagnostics = files.diagnostics;
    Node document = parse_toml(kExhibitFiles.front().text, std::string(kExhibitFiles.front().name));
    for (const WrittenFile& file : files.own) merge_layer(file, document, findings);
    const Exhibit own = read_merged(document).exhibit;
    for (const WrittenFile& file : files.drop_ins) merge_layer(file, document, findings);
    ExhibitReading reading{read_merged(document), {}};

    findings.origins = reading.loaded.origins;
    check(reading.loaded.exhibit, findings);
    check_drop_ins(own, reading, files, findings);
    if (std::string& scene = reading.loaded.exhibit.scene; is_scene_file(scene))
        scene = (files.folder / scene).lexically_normal().string();
    reading.diagnostics = ConfigError(std::move(findings.diagnostics)).diagnostics();
    return reading;
}

LoadedExhibit load_exhibit(const std::filesystem::path& folder) {
    return load_or_throw(read_exhibit_files(folder)).loaded;
}

LoadedExhibit load_exhibit_file(const std::filesystem::path& file) {
    ExhibitFiles files;
    const std::filesystem::path folder = std::filesystem::absolute(file).lexically_normal().parent_path();
    files.folder = folder.filename() == "conf.d" ? folder.parent_path() : folder;
    read_one(file, Links::Follow, files.own, files);
    return load_or_throw(files).loaded;
}

std::string print_exhibit(Exhibit exhibit, const Origins* origins) {
    Printer printer(origins);
    describe(printer, exhibit);
    return printer.text();
}

bool is_exhibit_key(std::string_view name) {
    Exhibit exhibit;
    ExhibitKeys keys;
    describe(keys, exhibit);
    return keys.has(name);
}

bool is_exhibit_table(std::string_view name) {
    Exhibit exhibit;
    ExhibitKeys keys;
    describe(keys, exhibit);
    return keys.has_inside(name);
}

std::vector<KeyChange> changed_keys(Exhibit from, Exhibit to) {
    ExhibitKeys before, after;
    describe(before, from);
    describe(after, to);
    return after.changes_since(before);
}

Exhibit without_restart(Exhibit running, Exhibit next) {
    ExhibitKeys before, after;
    describe(before, running);
    describe(after, next);
    after.keep(before, [](TakesEffect when) { return when > TakesEffect::Scene; });
    return next;
}

std::string exhibit_reference() {
    Reference reference(Reference::Keys::OfExhibit);
    Exhibit exhibit;
    describe(reference, exhibit);
    return reference.text();
}

std::string exhibit_schema() {
    JsonSchema schema;
    Exhibit exhibit;
    describe(schema, exhibit);
    return schema.text("Settings of an Eddy exhibit");
}

}  // namespace eddy
