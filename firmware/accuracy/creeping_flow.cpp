#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"
#include "firmware/accuracy/references.h"

// B3   A ball that moves slowly in a cube of no-slip walls feels 6 pi mu a U times K (Stokes 1851), here K(a / L = 0.2).
// B4   One that turns feels the torque 8 pi mu a^3 Omega times K_r.

namespace eddy::accuracy {
namespace {

/// The scene with its ball 0.38 cells off the middle, where no plane of symmetry is one of the grid.
Scene off_the_cells(Scene scene) {
    scene.bodies[0].centre_m += scene.tank.cell_m() * glm::dvec3(0.31, 0.22, 0.12);
    return scene;
}

double drag_factor(Laboratory& lab, const Scene& scene) {
    const glm::dvec3 force = lab.start(scene).step_to_end().loads[0].force_n;
    const Scene::Body& ball = scene.bodies[0];
    const double speed = glm::length(ball.velocity_m_s);
    return -glm::dot(force, ball.velocity_m_s) / speed /
           (6.0 * std::numbers::pi * scene.fluid.viscosity_pa_s * ball.radius_m * speed);
}

double torque_factor(Laboratory& lab, const Scene& scene) {
    const glm::dvec3 torque = lab.start(scene).step_to_end().loads[0].torque_nm;
    const Scene::Body& ball = scene.bodies[0];
    const double spin = glm::length(ball.spin_rad_s);
    return -glm::dot(torque, ball.spin_rad_s) / spin /
           (8.0 * std::numbers::pi * scene.fluid.viscosity_pa_s * std::pow(ball.radius_m, 3) * spin);
}

std::vector<double> drag(Laboratory& lab) {
    return {drag_factor(lab, lab.scene()), drag_factor(lab, off_the_cells(lab.scene()))};
}

std::vector<double> torque(Laboratory& lab) {
    return {torque_factor(lab, lab.scene()), torque_factor(lab, off_the_cells(lab.scene()))};
}

/// A factor in the middle, judged for its order too, and 0.38 cells off it.
std::vector<Quantity> factors(const std::string& name, double exact) {
    const std::vector<Limit> limits{{32, 0.03}, {48, 0.015}};
    const auto relative = Quantity::Error::Relative;
    return {{.name = name,
             .exact = exact,
             .source = "method of fundamental solutions, two resolutions agree to 5 digits",
             .error = relative,
             .limits = limits,
             .least_order = 1.7},
            {.name = name + " off the cells",
             .exact = exact,
             .source = "the same, 0.38 cells off the middle",
             .error = relative,
             .limits = limits}};
}

}  // namespace

std::vector<Case> creeping_flow_cases() {
    // The steps are so long that only where they lead counts; on finer grids they stay as long.
    return {{.name = "B3",
             .title = "Stokes drag of a ball in a no-slip cube over 6 pi mu a U",
             .scene = "validation/B3",
             .quick = {20, 32},
             .full = {20, 25, 32, 48, 64},
             .quantities = factors("K", references::kDragInBox),
             .measure = drag},
            {.name = "B4",
             .title = "torque on a turning ball in a no-slip cube over 8 pi mu a^3 Omega",
             .scene = "validation/B4",
             .quick = {20, 32},
             .full = {20, 25, 32, 48, 64},
             .quantities = factors("K_r", references::kTorqueInBox),
             .measure = torque}};
}

}  // namespace eddy::accuracy
