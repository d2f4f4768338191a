#include <fmt/format.h>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/scene_parts.h"

namespace eddy::stability {
namespace {

/// A hundred times that of air, 1 / 293 K.
constexpr double kExpansion = 0.34;

Case swirls(double strength_1_s) {
    return {.number = 17,
            .name = fmt::format("confinement-{:g}", strength_1_s),
            .title = fmt::format("vorticity confinement of {:g} 1/s while the ball stirs", strength_1_s),
            .provokes = "a force along the flow: energy is pumped in without bound",
            .wants = "kinetic energy levels off, or is far below that of a tank as fast as the ball",
            .when_red =
                "confinement gives eddies back what friction takes of them, as it is meant to: on few cells "
                "they are as large as the ball, which feels them for longer than it would without",
            .change =
                [strength_1_s](Scene& s) {
                    s.vorticity_confinement.emplace().strength_1_s = strength_1_s;
                    // Without friction a stir adds up for ever. Here friction's time is L^2 / (pi^2 nu) = 9 s.
                    s.fluid.viscosity_pa_s = 3e-4 * s.fluid.density_kg_m3;
                },
            .complaint = energy_levels_off_or_is_small(),
            // The strongest feeds the flow until the limit holds it: longer than friction takes.
            .steps = strength_1_s > 10.0 ? 2500 : 1500,
            .least_steps = strength_1_s > 10.0 ? 2500 : 1500,
            .calm_share = 0.0,
            .calm_s = 10.0};
}

Case hot(const char* name, const char* title, std::function<void(Scene&)> change) {
    return {.number = 18,
            .name = name,
            .title = title,
            .provokes = "a plume that crosses many cells in a step",
            .wants = "speeds stay below 1.5 sqrt(2 g' L)",
            .change =
                [change](Scene& s) {
                    s.fluid.gravity_m_s2 = {0.0, -9.81, 0.0};
                    s.temperature.emplace().expansion_1_k = kExpansion;
                    change(s);
                },
            .script = [](Moment& m) { m.hand_m = m.middle_m(); },
            .complaint = no_faster_than_a_fall(kExpansion),
            .calm_share = 0.0};
}

void stove(Scene& s, double height) {
    Scene::Source& stove = s.sources.emplace_back();
    stove.name = "stove";
    stove.centre_m = s.tank.size_m * glm::dvec3(0.5, height, 0.5);
    stove.radius_m = 0.15 * shortest_side_m(s);
    stove.temperature_k_per_s = 40.0;
}

}  // namespace

std::vector<Case> effect_cases() {
    std::vector<Case> cases;
    for (const double strength : {0.0, 2.0, 6.0, 20.0}) cases.push_back(swirls(strength));
    cases.push_back(hot("hot-floor", "a stove on the floor, buoyancy a hundred times that of air",
                        [](Scene& s) { stove(s, 0.05); }));
    cases.push_back(hot("hot-under-ball", "a stove just under the ball, buoyancy a hundred times that of air",
                        [](Scene& s) { stove(s, 0.2); }));
    cases.push_back(
        hot("unstable-column", "all of the lower half is 10 K warmer than the upper", [](Scene& s) {
            s.temperature->initial_k = Formula::parse(
                fmt::format("10 * (y < {:.9g}) + 0.1 * sin(300 * x) * sin(200 * z)", 0.5 * s.tank.size_m.y));
        }));
    return cases;
}

}  // namespace eddy::stability
