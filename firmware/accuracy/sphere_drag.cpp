#include <numbers>

#include "firmware/accuracy/case.h"
#include "firmware/accuracy/convergence.h"

// B6   Drag of a ball in a steady stream, C_D = F / (rho U^2 pi a^2 / 2).

namespace eddy::accuracy {
namespace {

double drag_coefficient(Laboratory& lab, const Scene& scene) {
    const double force = lab.start(scene).step_to_end().loads[0].force_n.x;
    const double speed = scene.tank.walls.x_low.velocity_m_s->evaluate({}, 0.0).x,
                 a = scene.bodies[0].radius_m;
    return force / (0.5 * scene.fluid.density_kg_m3 * speed * speed * std::numbers::pi * a * a);
}

std::vector<double> in_narrow_duct(Laboratory& lab) {
    return {drag_coefficient(lab, lab.scene())};
}

/// The share of the duct's section that the ball blocks.
double blockage(const Scene& scene) {
    const double a = scene.bodies[0].radius_m;
    return std::numbers::pi * a * a / (scene.tank.size_m.y * scene.tank.size_m.z);
}

/// In the scene's duct, in one 8/5 as wide, and what a straight line through both gives for no walls.
std::vector<double> without_walls(Laboratory& lab) {
    const Scene& narrow = lab.scene();
    Scene wide = narrow;
    for (const int k : {1, 2}) {
        wide.tank.cells[k] = narrow.tank.cells[k] * 8 / 5;
        wide.tank.size_m[k] = wide.tank.cells[k] * narrow.tank.cell_m();
        wide.bodies[0].centre_m[k] = 0.5 * wide.tank.size_m[k];
    }
    const double in_narrow = drag_coefficient(lab, narrow), in_wide = drag_coefficient(lab, wide);
    return {linear_to_zero({blockage(wide), in_wide}, {blockage(narrow), in_narrow}), in_wide, in_narrow};
}

}  // namespace

std::vector<Case> sphere_drag_cases() {
    const auto relative = Quantity::Error::Relative;
    const std::string own = "this solver on 96 cells, 16 a diameter; on 48 cells it is within 0.8 % of that";
    const auto narrow = [&](const std::string& name, const std::string& title, std::vector<std::string> set,
                            double exact) {
        return Case{
            .name = name,
            .title = title,
            .scene = "validation/B6",
            .set = std::move(set),
            .time_step = TimeStep::Courant,
            .quick = {24, 48},
            .full = {24, 36, 48, 72},
            .quantities =
                {{.name = "C_D", .exact = exact, .source = own, .error = relative, .limits = {{48, 0.05}}}},
            .measure = in_narrow_duct};
    };
    return {narrow("B6-Re10", "drag of a ball at Re 10 in a duct 4 diameters wide", {}, 5.067),
            narrow("B6-Re20", "the same at Re 20", {"fluid.viscosity_pa_s=0.1"}, 3.140),
            {.name = "B6-Re100",
             .title = "drag of a ball at Re 100 in ducts 5 and 8 diameters wide, and without walls",
             .scene = "validation/B6-Re100",
             .time_step = TimeStep::Courant,
             .full = {130},
             .quantities = {{.name = "C_D without walls",
                             .exact = 1.087,
                             .source = "steady axisymmetric spectral solution; Clift, Grace and Weber 1978",
                             .error = relative,
                             .limits = {{130, 0.1}}},
                            {.name = "C_D 8 wide", .exact = 1.087, .source = "the same", .error = relative},
                            {.name = "C_D 5 wide", .exact = 1.087, .source = "the same", .error = relative}},
             .measure = without_walls}};
}

}  // namespace eddy::accuracy
