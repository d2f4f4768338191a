#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"
#include "firmware/accuracy/references.h"
#include "firmware/force_comparison.h"
#include "gles/body/mass_properties.h"

// F1   The force measured three ways (outputs.force_methods), where it is known: is what the three differ by as much as what
//      they are off? All three take the pressure and the velocity as they came out and tell only whether the sums over them
//      agree. B4 is not here: torque is measured one way.

namespace eddy::accuracy {
namespace {

double volume_m3(const Run& run) {
    return gles::mass_properties(run.setup().bodies[0].shape).volume_m3;
}

/// What the force on the first body should be [N].
using ExactForce = std::function<glm::dvec3(const Scene&, const Run&)>;

glm::dvec3 lift(const Scene& scene, const Run& run) {
    return -scene.fluid.density_kg_m3 * volume_m3(run) * scene.fluid.gravity_m_s2;
}

ExactForce inertia(double added_mass) {
    return [added_mass](const Scene& scene, const Run& run) {
        return -added_mass * scene.fluid.density_kg_m3 * volume_m3(run) * scene.bodies[0].acceleration_m_s2;
    };
}

glm::dvec3 drag(const Scene& scene, const Run&) {
    const Scene::Body& ball = scene.bodies[0];
    return -references::kDragInBox * 6.0 * std::numbers::pi * scene.fluid.viscosity_pa_s * ball.radius_m *
           ball.velocity_m_s;
}

/// Force over what it should be, and spread of the three ways: where the scene has the ball, and half a cell off.
std::vector<double> force_and_spread(Laboratory& lab, const ExactForce& exact_force) {
    std::vector<double> values;
    for (const glm::dvec3& cells : {glm::dvec3(0.0), glm::dvec3(0.31, 0.22, 0.32)}) {
        Scene scene = lab.scene();
        for (Scene::Body& body : scene.bodies) body.centre_m += scene.tank.cell_m() * cells;
        Run run = lab.start(scene);
        const std::vector<gles::Load> loads = run.step_to_end().loads;
        const glm::dvec3 exact = exact_force(scene, run);
        values.push_back(glm::dot(loads[0].force_n, exact) / glm::dot(exact, exact));
        ForceComparison comparison(loads.size());
        comparison.add(loads, run.fluid().force_methods());
        values.push_back(comparison.spread(0).value());
    }
    return values;
}

Case three_ways(const std::string& name, const std::string& title, const std::string& scene,
                std::vector<int> quick, std::vector<int> full, const std::string& source,
                const ExactForce& exact) {
    std::vector<Quantity> quantities;
    for (const char* place : {"", " off the cells"}) {
        quantities.push_back({.name = std::string("F / exact") + place,
                              .exact = 1.0,
                              .source = source,
                              .error = Quantity::Error::Relative});
        quantities.push_back({.name = std::string("spread / F") + place,
                              .source = "the three ways measure the same force",
                              .estimates_error = true});
    }
    return {.name = name,
            .title = title,
            .scene = scene,
            .set = {"outputs.force_methods=true"},
            .quick = std::move(quick),
            .full = std::move(full),
            .quantities = quantities,
            .measure = [exact](Laboratory& lab) { return force_and_spread(lab, exact); }};
}

}  // namespace

std::vector<Case> three_ways_cases() {
    return {three_ways("F1-rest", "three ways to measure the lift of a ball at rest, and its error",
                       "validation/B1-sphere", {16, 24}, {16, 24, 32, 48}, "Archimedes, as B1", lift),
            three_ways("F1-box", "the same of a ball that speeds up in a box", "validation/B2-box", {24, 30},
                       {24, 30, 40, 60}, "added mass, as B2-box", inertia(references::kAddedMassInBox)),
            three_ways("F1-shell", "the same in a shell", "validation/B2-shell", {26}, {26, 39, 52},
                       "added mass, as B2-shell", inertia(references::kAddedMassInShell)),
            three_ways("F1-drag", "the same in creeping flow", "validation/B3", {16, 24}, {16, 24, 32, 48},
                       "Stokes drag between walls, as B3", drag)};
}

}  // namespace eddy::accuracy
