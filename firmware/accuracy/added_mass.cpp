#include <cmath>

#include "firmware/accuracy/case.h"
#include "firmware/accuracy/references.h"
#include "gles/body/mass_properties.h"

// B2   A ball that speeds up at a in an inviscid fluid feels F = -C_m rho V a, whatever the time step.

namespace eddy::accuracy {
namespace {

/// C_m of the first body, from the last step: by then the body's velocity rises by a dt a step.
double added_mass(Laboratory& lab, const glm::dvec3& offset_cells) {
    Scene scene = lab.scene();
    for (Scene::Body& body : scene.bodies) body.centre_m += scene.tank.cell_m() * offset_cells;
    Run run = lab.start(scene);
    const glm::dvec3 force = run.step_to_end().loads[0].force_n, a = scene.bodies[0].acceleration_m_s2;
    const double volume = gles::mass_properties(run.setup().bodies[0].shape).volume_m3;
    return -glm::dot(force, a) / (scene.fluid.density_kg_m3 * volume * glm::dot(a, a));
}

std::vector<double> at_places(Laboratory& lab) {
    return {added_mass(lab, glm::dvec3(0.0)), added_mass(lab, {0.31, 0.47, 0.08})};
}

}  // namespace

std::vector<Case> added_mass_cases() {
    const auto c_m = [](const std::string& name, double exact, const std::string& source,
                        std::vector<Limit> limits) {
        return Quantity{.name = name,
                        .exact = exact,
                        .source = source,
                        .error = Quantity::Error::Relative,
                        .limits = std::move(limits)};
    };
    const std::string mfs = "method of fundamental solutions, residual below 1e-4: a / L = 0.1";
    const std::string shell = "(1 + 2 l^3) / (2 (1 - l^3)), l = 0.4 (Lamb, Hydrodynamics)";
    return {{.name = "B2-box",
             .title = "added mass of a ball in the middle of a cubic box; 60 cells: a radius of 6",
             .scene = "validation/B2-box",
             .quick = {30, 60},
             .full = {30, 45, 60, 90},
             .quantities = {c_m("C_m", references::kAddedMassInBox, mfs, {{30, 0.04}, {60, 0.012}}),
                            c_m("C_m off the cells", references::kAddedMassInBox,
                                "the same, 0.57 cells off the middle", {{30, 0.04}, {60, 0.012}})},
             .measure = at_places},
            {.name = "B2-shell",
             .title = "added mass of a ball in a round shell; 26 cells: radii of 4.8 and 12",
             .scene = "validation/B2-shell",
             .quick = {26},
             .full = {26, 39, 52},
             .quantities = {c_m("C_m", references::kAddedMassInShell, shell, {{26, 0.02}}),
                            c_m("C_m off the cells", references::kAddedMassInShell,
                                "the same, both 0.57 cells aside", {{26, 0.02}})},
             .measure = at_places}};
}

}  // namespace eddy::accuracy
