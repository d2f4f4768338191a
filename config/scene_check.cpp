#include "config/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "config/override.h"

namespace eddy {
namespace {

std::string item(const char* list, std::size_t i) {
    return fmt::format("{}.{}", list, i);
}

class Check {
  public:
    Check(const Scene& scene, Findings& findings) : scene_(scene), findings_(findings) {}

    void cells_are_cubes() {
        if (blamed("tank")) return;
        const glm::dvec3 size = scene_.tank.size_m;
        const glm::dvec3 cells(scene_.tank.cells);
        const glm::dvec3 width = size / cells;
        const double widest = std::max({width.x, width.y, width.z});
        const double narrowest = std::min({width.x, width.y, width.z});
        if (widest - narrowest <= 1e-4 * narrowest) return;
        // The cube that changes size_m least, in the sense of least squares.
        const double cube = glm::dot(size, cells) / glm::dot(cells, cells);
        blame(given("tank.size_m") ? "tank.size_m" : "tank.cells",
              fmt::format(
                  "cells must be cubes, but are {:.6g} x {:.6g} x {:.6g} m; nearest size_m that is right: "
                  "[{:.6g}, {:.6g}, {:.6g}]",
                  width.x, width.y, width.z, cube * cells.x, cube * cells.y, cube * cells.z));
    }

    void source_makes_sense(std::size_t i) {
        const Scene::Source& source = scene_.sources[i];
        const std::string path = item("source", i);
        name_is_usable(path, source.name);
        if (given(path + ".smoke_per_s") && !scene_.smoke)
            blame(path + ".smoke_per_s", "needs the smoke effect: add a table [smoke], or remove this key");
        if (!given(path + ".smoke_per_s") && !given(path + ".velocity_m_s"))
            blame(path, "does nothing: give it smoke_per_s, velocity_m_s or both");
        if (source.stop_s && *source.stop_s <= source.start_s && !blamed(path + ".start_s"))
            blame(path + ".stop_s", fmt::format("must be after start_s = {}", source.start_s));
        reaches_the_tank(path, source.centre_m, source.radius_m);
    }

    void body_makes_sense(std::size_t i) {
        const Scene::Body& body = scene_.bodies[i];
        const std::string path = item("body", i);
        name_is_usable(path, body.name);
        if (blamed(path + ".motion")) return;
        if (body.motion != BodyMotion::Held && !given(path + ".centre_m"))
            blame(path + ".centre_m", "is missing here: write centre_m = a list of 3 numbers");
        if (body.motion != BodyMotion::Prescribed) only_prescribed_moves(path, body);
        if (body.motion == BodyMotion::Fixed) reaches_the_tank(path, body.centre_m, body.radius_m);
        if (std::error_code error;
            !body.path_csv.empty() && !std::filesystem::is_regular_file(body.path_csv, error))
            blame(path + ".path_csv", fmt::format("there is no file {}", in_quotes(body.path_csv.string())));
    }

    void at_most_one_is_held() {
        std::size_t held = 0;
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            if (scene_.bodies[i].motion == BodyMotion::Held && held++ > 0)
                blame(item("body", i) + ".motion",
                      "a second held body: the visitor has one hand on the handle");
        }
    }

    void solver_keys_fit_the_preset() {
        if (blamed("solver.preset")) return;
        const bool yang = scene_.solver.preset == SolverPreset::Yang2009;
        const std::string preset = in_quotes(to_word(scene_.solver.preset));
        if (given("solver.jacobi_sweeps") && !yang)
            blame("solver.jacobi_sweeps", "is for preset = \"yang2009\", but preset is " + preset);
        if (given("solver.cycles") && yang)
            blame("solver.cycles", "is for multigrid, but preset is " + preset + "; use jacobi_sweeps");
    }

    void hand_is_in_the_tank() {
        if (given("haptics.centre_m")) reaches_the_tank("haptics", scene_.haptics.centre_m, 0.0);
    }

    void fields_exist() {
        const auto& fields = scene_.outputs.fields;
        if (!scene_.smoke && std::count(fields.begin(), fields.end(), OutputField::Smoke))
            blame("outputs.fields", "there is no smoke to write: add a table [smoke], or remove \"smoke\"");
    }

  private:
    bool given(const std::string& key) const { return findings_.origins.contains(key); }

    // Whether the key, or anything inside it, is known to be wrong already.
    bool blamed(const std::string& key) const {
        return std::any_of(findings_.diagnostics.begin(), findings_.diagnostics.end(),
                           [&](const Diagnostic& d) {
                               return d.key == key || d.key.substr(0, key.size() + 1) == key + ".";
                           });
    }

    void blame(const std::string& key, const std::string& message) {
        if (!blamed(key)) findings_.blame(place_of(findings_.origins, key), key, message);
    }

    // Zeros are harmless, and print_scene() writes them.
    void only_prescribed_moves(const std::string& path, const Scene::Body& body) {
        const std::pair<const char*, bool> moves[] = {
            {"velocity_m_s", body.velocity_m_s != glm::dvec3(0.0)},
            {"acceleration_m_s2", body.acceleration_m_s2 != glm::dvec3(0.0)},
            {"spin_rad_s", body.spin_rad_s != glm::dvec3(0.0)},
            {"path_csv", !body.path_csv.empty()},
            {"start_s", body.start_s != 0.0},
            {"oscillation", body.oscillation.has_value()}};
        for (const auto& [key, moving] : moves) {
            if (moving)
                blame(fmt::format("{}.{}", path, key),
                      fmt::format("is for motion = \"prescribed\", but motion is {}",
                                  in_quotes(to_word(body.motion))));
        }
    }

    // Names head columns of series.csv and are steps of override paths.
    void name_is_usable(const std::string& path, const std::string& name) {
        const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
        const auto inner = [&](char c) {
            return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
        };
        if (name.empty() || !letter(name.front()) || !std::all_of(name.begin(), name.end(), inner))
            blame(path + ".name",
                  in_quotes(name) + " is no name: use letters, digits, - and _, a letter first");
        else if (!names_.insert(path.substr(0, path.find('.') + 1) + name).second)
            blame(path + ".name", in_quotes(name) + " is taken already: each must have its own name");
    }

    // A ball that touches no fluid would silently do nothing.
    void reaches_the_tank(const std::string& path, const glm::dvec3& centre, double radius) {
        if (blamed(path) || blamed("tank")) return;
        const glm::dvec3 size = scene_.tank.size_m;
        const glm::dvec3 nearest = glm::clamp(centre, glm::dvec3(0.0), size);
        if (glm::distance(centre, nearest) <= radius) return;
        blame(path + ".centre_m",
              fmt::format("is outside the tank, which reaches from [0, 0, 0] to {}", to_toml(size)));
    }

    const Scene& scene_;
    Findings& findings_;
    std::set<std::string> names_;
};

}  // namespace

void resolve(Scene& scene, const Origins& origins, const std::filesystem::path& folder) {
    if (!origins.contains("haptics.centre_m")) scene.haptics.centre_m = 0.5 * scene.tank.size_m;
    for (std::size_t i = 0; i < scene.sources.size(); ++i) {
        if (!origins.contains(item("source", i) + ".name"))
            scene.sources[i].name = fmt::format("source{}", i + 1);
    }
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        Scene::Body& body = scene.bodies[i];
        const std::string path = item("body", i);
        if (!origins.contains(path + ".name")) body.name = fmt::format("body{}", i + 1);
        if (!origins.contains(path + ".centre_m")) body.centre_m = scene.haptics.centre_m;
        if (body.path_csv.empty()) continue;
        const bool overridden = place_of(origins, path + ".path_csv").file == kOverrideFile;
        const auto start = std::filesystem::current_path() / (overridden ? "" : folder);
        body.path_csv = (start / body.path_csv).lexically_normal();
    }
}

void check(const Scene& scene, Findings& findings) {
    Check check(scene, findings);
    check.cells_are_cubes();
    for (std::size_t i = 0; i < scene.sources.size(); ++i) check.source_makes_sense(i);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) check.body_makes_sense(i);
    check.at_most_one_is_held();
    check.solver_keys_fit_the_preset();
    check.hand_is_in_the_tank();
    check.fields_exist();
}

}  // namespace eddy
