#include <algorithm>
#include <cmath>

#include "firmware/accuracy/convergence.h"
#include "firmware/accuracy/identity.h"
#include "firmware/force_comparison.h"
#include "gles/fluid/face_shares.h"

// B8.1   Momentum of a fluid in a closed tank and of what its bodies displace: together 0, as no volume leaves.
// B8.2   What a body takes from the fluid's momentum, by a balance in a box around it, is the force on it.
// B8.3   Work of the bodies on the fluid, and its energy: from rest, the first is twice the second; later, the fluid never
//        gives back more than it got.

namespace eddy::accuracy {
namespace {

gles::OnFaces shares(Laboratory& lab, const Run& run) {
    return gles::face_shares(lab.gpu(), run.setup(), run.fluid().bodies());
}

/// sum (1 - a) u_solid over all faces but walls; a face beside two bodies far apart is that of the nearer one.
glm::dvec3 solid_flux(const gles::OnFaces& a, const Run& run) {
    const std::vector<gles::BodyState>& bodies = run.fluid().bodies();
    const double h = run.setup().cell_m;
    glm::dvec3 total(0.0);
    for (int z = 0; z < a.cells.z; ++z)
        for (int y = 0; y < a.cells.y; ++y)
            for (int x = 0; x < a.cells.x; ++x)
                for (int k = 0; k < 3; ++k) {
                    const glm::ivec3 cell(x, y, z);
                    if (cell[k] == 0) continue;
                    glm::dvec3 face = h * (glm::dvec3(cell) + 0.5);
                    face[k] -= 0.5 * h;
                    const auto nearest = std::min_element(
                        bodies.begin(), bodies.end(),
                        [&](const gles::BodyState& p, const gles::BodyState& q) {
                            return glm::distance(p.centre_m, face) < glm::distance(q.centre_m, face);
                        });
                    const glm::dvec3 u =
                        nearest->velocity_m_s + glm::cross(nearest->spin_rad_s, face - nearest->centre_m);
                    total[k] += (1.0 - a.values[a.index(cell)][k]) * u[k];
                }
    return total;
}

std::vector<double> momentum(Laboratory& lab, const Scene& scene) {
    Run run = lab.start(scene);
    run.step_to_end();
    const gles::OnFaces a = shares(lab, run);
    const glm::dvec3 of_fluid = gles::sum(a, run.fluid().velocity()), of_solids = solid_flux(a, run);
    return {glm::length(of_fluid + of_solids) / glm::length(of_solids)};
}

std::vector<double> balance(Laboratory& lab, Scene scene) {
    scene.outputs.force_methods = true;
    Run run = lab.start(scene);
    ForceComparison comparison(scene.bodies.size());
    run.step_to_end(
        [&](const gles::StepResult& result) { comparison.add(result.loads, run.fluid().force_methods()); });
    double spread = 0.0, transport = 0.0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        spread = worse(spread, comparison.spread(i).value());
        transport = worse(transport, comparison.transport(i).value());
    }
    return {spread, transport};
}

/// Of the bodies on the fluid in a step [J].
double work(const Run& run, const gles::StepResult& result) {
    double sum = 0.0;
    for (std::size_t i = 0; i < result.loads.size(); ++i) {
        const gles::BodyState& body = run.fluid().bodies()[i];
        sum -= glm::dot(result.loads[i].force_n, body.velocity_m_s) +
               glm::dot(result.loads[i].torque_nm, body.spin_rad_s);
    }
    return run.dt_s() * sum;
}

/// Of the fluid, without what it would be where the bodies are [J].
double energy(Laboratory& lab, const Run& run) {
    return 0.5 * run.setup().density_kg_m3 * std::pow(run.setup().cell_m, 3) *
           gles::sum_of_squares(shares(lab, run), run.fluid().velocity());
}

std::vector<double> energy_and_work(Laboratory& lab, const Scene& scene) {
    Run run = lab.start(scene);
    double worked = 0.0, lost = 0.0, given_back = 0.0, most = 0.0, first = 0.0;
    run.step_to_end([&](const gles::StepResult& result) {
        worked += work(run, result);
        const double now = energy(lab, run);
        if (result.step == 1) first = 2.0 * now / worked;
        most = worse(most, now);
        given_back = worse(given_back, lost - (worked - now));
        lost = worse(lost, worked - now);
    });
    return {first, given_back / most};
}

}  // namespace

std::vector<Case> balance_cases() {
    return {at_both_presets({.name = "B8.1",
                             .title = "momentum of the fluid and of what its bodies displace",
                             .quantities = {{.name = "their sum / the latter",
                                             .source = "no volume leaves a closed tank",
                                             .limits = {{25, 1e-4}}}},
                             .measure = momentum}),
            at_both_presets({.name = "B8.2",
                             .title = "the force on a body, and what it takes from the fluid's momentum",
                             .quantities = {{.name = "their difference / F",
                                             .source = "conservation of momentum; the worse body",
                                             .limits = {{25, 1e-3}}},
                                            {.name = "made by transport / F",
                                             .source = "a transport that conserved momentum would make none",
                                             .limits = {{25, 0.3}}}},
                             .measure = balance}),
            at_both_presets({.name = "B8.3",
                             .title = "work of the bodies on the fluid, and its energy",
                             .quantities = {{.name = "2 E / work, from rest",
                                             .exact = 1.0,
                                             .source = "u is orthogonal to what the pressure took of it",
                                             .limits = {{25, 0.01}}},
                                            {.name = "given back / E",
                                             .source = "the fluid gives back no more than it got",
                                             .limits = {{25, 0.01}}}},
                             .measure = energy_and_work})};
}

}  // namespace eddy::accuracy
