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
    return {at_rest("A7-inviscid", "water with a turned box in it stays at rest, 50 steps", {}),
            at_rest("A7-viscous", "the same, a viscous fluid that sticks to walls and box",
                    {"fluid.viscosity_pa_s=1.0", "tank.walls=\"no_slip\""}),
            at_rest("A7-layered", "the same, twice as heavy at the bottom as at the top",
                    {"smoke.weight=1.0", "smoke.initial=\"1 - y / 0.17\""})};
}

}  // namespace eddy::accuracy
