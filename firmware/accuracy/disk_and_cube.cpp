#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"

// B7   Bodies with edges: a disk in creeping flow, and a cube in a stream at Re 10.

namespace eddy::accuracy {
namespace {

// --- the disk

/// Drag on the disk at its steady end over its speed [kg/s].
double resistance(Laboratory& lab, const Scene& scene) {
    const glm::dvec3 force = lab.start(scene).step_to_end().loads[0].force_n,
                     u = scene.bodies[0].velocity_m_s;
    return -glm::dot(force, u) / glm::dot(u, u);
}

/// Without the walls of a no-slip cube of side L, which do to it about what they do to a ball of the same drag, of radius b:
/// 6 pi mu b / (1 - 3.886 l + 12.5 l^3), l = b / L (method of fundamental solutions, within 0.2 % of it for l <= 0.15).
double unbounded(double resistance, const Scene& scene) {
    const double unit = 6.0 * std::numbers::pi * scene.fluid.viscosity_pa_s * scene.tank.size_m.x;
    double low = 0.0, high = 0.2;
    for (int i = 0; i < 60; ++i) {
        const double l = 0.5 * (low + high);
        (unit * l / (1.0 - 3.886 * l + 12.5 * l * l * l) < resistance ? low : high) = l;
    }
    return unit * low;
}

std::vector<double> broadside_and_edge_on(Laboratory& lab) {
    const Scene& scene = lab.scene();
    Scene turned = scene;
    turned.bodies[0].axis = {1.0, 0.0, 0.0};
    turned.bodies[0].angle_deg = 90.0;
    const double broad = resistance(lab, scene), edge = resistance(lab, turned);
    const double broad_alone = unbounded(broad, scene), edge_alone = unbounded(edge, scene);
    const double unit = scene.fluid.viscosity_pa_s * scene.bodies[0].radius_m;
    return {broad_alone / unit, edge_alone / unit, broad_alone / edge_alone, broad / edge};
}

// --- the cube

std::vector<double> drag_coefficient(Laboratory& lab) {
    const Scene& scene = lab.scene();
    const double force = lab.start().step_to_end().loads[0].force_n.x;
    const double speed = scene.tank.walls.x_low.velocity_m_s->evaluate({}, 0.0).x;
    const double edge = scene.bodies[0].size_m.x;
    const double a = edge * std::cbrt(0.75 / std::numbers::pi);  // of a ball of the same volume
    return {force / (0.5 * scene.fluid.density_kg_m3 * speed * speed * std::numbers::pi * a * a)};
}

}  // namespace

std::vector<Case> disk_and_cube_cases() {
    const auto relative = Quantity::Error::Relative;
    const std::string thin =
        "a disk without thickness and walls, Oberbeck 1876; this one has a quarter of its radius";
    return {
        {.name = "B7-disk",
         .title = "a disk in creeping flow, flat side ahead and edge ahead",
         .scene = "validation/B7-disk",
         .quick = {32},
         .full = {32, 48, 64},
         .quantities = {{.name = "broadside / (mu a U)",
                         .exact = 16.0,
                         .source = thin,
                         .error = relative,
                         .limits = {{32, 0.05}}},
                        {.name = "edge-on / (mu a U)",
                         .exact = 32.0 / 3.0,
                         .source = thin,
                         .error = relative,
                         .limits = {{32, 0.2}}},
                        {.name = "their ratio", .exact = 1.5, .source = thin, .error = relative},
                        {.name = "ratio in the box",
                         .exact = 1.5,
                         .source = "the same, but walls add more to the greater",
                         .error = relative}},
         .measure = broadside_and_edge_on},
        {.name = "B7-cube",
         .title = "drag of a cube at Re 10 in a duct 4 diameters wide",
         .scene = "validation/B7-cube",
         .time_step = TimeStep::Courant,
         .quick = {24, 36},
         .full = {24, 36, 48, 72},
         // 4.754 unbounded; the duct raises the ball's from 4.28 to 5.136.
         .quantities =
             {{.name = "C_D",
               .exact = 4.754 * 5.136 / 4.28,
               .source = "Haider and Levenspiel 1989, +-10 %, times what the duct adds to a ball's (B6-Re10)",
               .error = relative,
               .limits = {{36, 0.1}}}},
         .measure = drag_coefficient}};
}

}  // namespace eddy::accuracy
