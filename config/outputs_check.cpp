#include <fmt/format.h>

#include <algorithm>

#include "config/scene_rules.h"

namespace eddy {
namespace {

void hand_is_in_the_tank(SceneRules& rules) {
    if (rules.given("haptics.centre_m"))
        rules.reaches_the_tank("haptics", "centre_m", rules.scene.haptics.centre_m, 0.0);
}

void fields_exist(SceneRules& rules) {
    const Scene& scene = rules.scene;
    const auto absent = [&](OutputField field, bool there, const char* cure) {
        const auto& fields = scene.outputs.fields;
        if (there || std::find(fields.begin(), fields.end(), field) == fields.end()) return;
        rules.blame("outputs.fields", fmt::format("there is no {0} to write: {1}, or remove {2}",
                                                  to_word(field), cure, in_quotes(to_word(field))));
    };
    absent(OutputField::Smoke, scene.smoke.has_value(), "add a table [smoke]");
    absent(OutputField::Temperature, scene.temperature.has_value(), "add a table [temperature]");
    absent(OutputField::Pressure, !scene.imposed, "remove [imposed], which leaves nothing to solve");
}

void probe_measures_something(SceneRules& rules, std::size_t i) {
    const Scene& scene = rules.scene;
    const Scene::Probe& probe = scene.probes[i];
    const std::string path = item("probe", i);
    rules.name_is_usable(path, probe.name);
    const auto absent = [&](ProbeQuantity quantity, bool there, const char* cure) {
        if (!there && probe.quantity == quantity)
            rules.blame(path + ".quantity",
                        fmt::format("there is no {} to measure: {}", to_word(quantity), cure));
    };
    if (!rules.blamed(path + ".quantity")) {
        absent(ProbeQuantity::Smoke, scene.smoke.has_value(), "add a table [smoke]");
        absent(ProbeQuantity::Temperature, scene.temperature.has_value(), "add a table [temperature]");
        absent(ProbeQuantity::Pressure, !scene.imposed, "remove [imposed], which leaves nothing to solve");
    }
    if (!scene.outputs.series) rules.blame(path, "writes to series.csv, but outputs.series is false");

    // Either a point or a whole line.
    for (const char* key : {"from_m", "to_m", "points"}) {
        const std::string whole_key = fmt::format("{}.{}", path, key);
        const bool line =
            rules.given(path + ".from_m") || rules.given(path + ".to_m") || rules.given(path + ".points");
        if (rules.given(path + ".point_m") && rules.given(whole_key))
            rules.blame(whole_key, "is for a line, but point_m is there: remove one of them");
        else if (line && !rules.given(path + ".point_m") && !rules.given(whole_key))
            rules.blame(whole_key, "is missing here: a line needs from_m, to_m and points");
        else if (!line && !rules.given(path + ".point_m"))
            rules.blame(path, "is nowhere: give it point_m, or from_m, to_m and points");
    }
    if (probe.point_m) rules.reaches_the_tank(path, "point_m", *probe.point_m, 0.0);
    if (probe.from_m) rules.reaches_the_tank(path, "from_m", *probe.from_m, 0.0);
    if (probe.to_m) rules.reaches_the_tank(path, "to_m", *probe.to_m, 0.0);
}

void force_methods_have_a_force(SceneRules& rules) {
    const Scene& scene = rules.scene;
    if (!scene.outputs.force_methods) return;
    if (std::none_of(scene.bodies.begin(), scene.bodies.end(), [](const Scene::Body& b) { return b.force; }))
        rules.blame("outputs.force_methods",
                    "there is no body whose force is measured: add one with force = true");
    else if (!scene.outputs.series)
        rules.blame("outputs.force_methods", "writes to series.csv, but outputs.series is false");
    else if (scene.solver.preset == SolverPreset::Yang2009)
        rules.blame("outputs.force_methods", "preset = \"yang2009\" measures the force in its own way only");
}

}  // namespace

void check_outputs(SceneRules& rules) {
    hand_is_in_the_tank(rules);
    fields_exist(rules);
    for (std::size_t i = 0; i < rules.scene.probes.size(); ++i) probe_measures_something(rules, i);
    force_methods_have_a_force(rules);
}

}  // namespace eddy
