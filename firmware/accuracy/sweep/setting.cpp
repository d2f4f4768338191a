#include "firmware/accuracy/sweep/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eddy::accuracy::sweep {
namespace {

constexpr std::pair<ForceWay, const char*> kForceWays[] = {
    {ForceWay::Surface, "surface"}, {ForceWay::Box, "box"}, {ForceWay::Impulse, "impulse"}};

}  // namespace

std::string word_of(ForceWay way) {
    for (const auto& [one, word] : kForceWays)
        if (one == way) return word;
    throw std::logic_error("a way without a word");
}

ForceWay force_way(const std::string& word) {
    for (const auto& [way, name] : kForceWays)
        if (word == name) return way;
    throw std::invalid_argument(fmt::format("there is no way to measure a force named '{}'", word));
}

std::string describe(const Setting& s) {
    std::string text = describe(Quality{s.method, s.cells, s.iterations});
    if (s.dt_factor != 1.0) text += fmt::format(", {} dt", s.dt_factor);
    if (s.force != ForceWay::Surface) text += ", force by " + word_of(s.force);
    return text;
}

Scene applied(Scene scene, const Setting& setting) {
    const Scene::Solver written = scene.solver;
    Scene::Solver& solver = scene.solver;
    solver = {};
    solver.preset = setting.method;
    solver.time_order = written.time_order;
    const double steps = scene.outputs.duration_s / (written.dt_s * setting.dt_factor);
    solver.dt_s = scene.outputs.duration_s / std::max(1.0, std::round(steps));
    if (setting.method == SolverPreset::Yang2009)
        solver.jacobi_sweeps = setting.iterations;
    else
        solver.cycles = setting.iterations;
    scene.outputs.force_methods = setting.force != ForceWay::Surface;
    return scene;
}

}  // namespace eddy::accuracy::sweep
