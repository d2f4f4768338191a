#include <cmath>

#include <fmt/format.h>

#include "firmware/accuracy/case.h"
#include "firmware/accuracy/references.h"

// B10  A ball that is let go in a fluid at rest sets off with (rho_b - rho) g / (rho_b + C_m rho), however light it is.

namespace eddy::accuracy {
namespace {

constexpr double kDensities[] = {0.01, 0.1, 2.0};  // of the ball over that of the fluid

/// Downwards, over g.
std::vector<double> first_acceleration(Laboratory& lab) {
    std::vector<double> shares;
    for (const double density : kDensities) {
        Scene scene = lab.scene();
        scene.bodies[0].density_kg_m3 = density * scene.fluid.density_kg_m3;
        Run run = lab.start(scene);
        run.step();
        const glm::dvec3 a = run.fluid().bodies()[0].velocity_m_s / run.dt_s(), g = scene.fluid.gravity_m_s2;
        shares.push_back(glm::dot(a, g) / glm::dot(g, g));
    }
    return shares;
}

}  // namespace

std::vector<Case> free_ball_cases() {
    std::vector<Quantity> accelerations;
    for (const double density : kDensities)
        accelerations.push_back(
            {.name = fmt::format("a / g, {} as dense", density),
             .exact = (density - 1.0) / (density + references::kAddedMassInTightBox),
             .source =
                 fmt::format("C_m = {}: method of fundamental solutions, residual below 1e-4: a / L = 0.2",
                             references::kAddedMassInTightBox),
             .error = Quantity::Error::Relative,
             .limits = {{24, 0.03}}});
    return {{.name = "B10",
             .title = "first acceleration of a ball let go, 0.01, 0.1 and 2 times as dense as the water",
             .scene = "validation/B10",
             .quick = {24, 32},
             .full = {24, 32, 48, 64},
             .quantities = accelerations,
             .measure = first_acceleration}};
}

}  // namespace eddy::accuracy
