#include <cmath>

#include "firmware/accuracy/case.h"

// A7   A fluid at rest under gravity stays at rest, whatever hangs in it and however it is layered. Speeds are in units of
//      sqrt(g L), which falling through the tank would give.

namespace eddy::accuracy {
namespace {

std::vector<double> fastest(Laboratory& lab) {
    Run run = lab.start();
    run.step_to_end();
    const Scene& scene = lab.scene();
    return {run.velocity().fastest_m_s() /
            std::sqrt(glm::length(scene.fluid.gravity_m_s2) * scene.tank.size_m.y)};
}

Case at_rest(const std::string& name, const std::string& title, std::vector<std::string> set) {
    return {.name = name,
            .title = title,
            .scene = "validation/A7",
            .set = std::move(set),
            .quick = {22},
            .full = {22, 44},
            .quantities = {{.name = "max |u| / sqrt(g L)", .source = "hydrostatics", .limits = {{22, 1e-5}}}},
            .measure = fastest};
}

}  // namespace

std::vector<Case> rest_cases() {
    std::vector<Case> cases{at_rest("A7-inviscid", "water with a turned box in it stays at rest", {}),
                            at_rest("A7-viscous", "the same in a viscous fluid that sticks to walls and box",
                                    {"fluid.viscosity_pa_s=1.0", "tank.walls=\"no_slip\""}),
                            at_rest("A7-layered", "the same, twice as heavy at the bottom as at the top",
                                    {"smoke.weight=1.0", "smoke.initial=\"1 - y / 0.17\""})};
    const std::vector<Case> short_ones = cases;
    for (Case one : short_ones) {
        one.name.insert(2, "-long");
        one.title += ": 1000 steps";
        one.set.emplace_back("outputs.duration_s=10");
        one.quick.clear();
        one.full = {22};
        cases.push_back(one);
    }
    return cases;
}

}  // namespace eddy::accuracy
