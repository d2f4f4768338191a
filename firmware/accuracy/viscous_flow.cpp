#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"

// A12  Flows that only friction shapes. In a square duct of side H, driven by G per volume (Boussinesq 1868; White, Viscous
//      Fluid Flow):  mu lap u = -G,  mean of u = 0.0351443 G H^2 / mu.  Over a floor that began to slide at t = 0 (Stokes
//      1851):  u / U = erfc(y / (2 sqrt(nu t))).

namespace eddy::accuracy {
namespace {

/// u mu / (G H^2) at (y, z) in units of H, from the middle of the duct.
double duct_profile(double y, double z) {
    constexpr double kPi = std::numbers::pi;
    double sum = 0.0;
    for (int i = 1; i < 200; i += 2) {
        const double k = i * kPi, sign = i % 4 == 1 ? 1.0 : -1.0;
        // cosh(k z) / cosh(k / 2) without overflow
        const double ratio = std::exp(k * (std::abs(z) - 0.5)) * (1.0 + std::exp(-2.0 * k * std::abs(z))) /
                             (1.0 + std::exp(-k));
        sum += sign * (1.0 - ratio) * std::cos(k * y) / (k * k * k);
    }
    return 4.0 * sum;
}

std::vector<double> duct(Laboratory& lab) {
    Run run = lab.start();
    run.step_to_end();
    const Scene& scene = lab.scene();
    const double side = scene.tank.size_m.y;
    const double drive = scene.fluid.density_kg_m3 * scene.forcing->acceleration_m_s2.evaluate({}, 0.0).x;
    const double unit = drive * side * side / scene.fluid.viscosity_pa_s;
    const FaceVelocity u = run.velocity();
    const auto exact = [&](const glm::dvec3& x) {
        return glm::dvec3(unit * duct_profile(x.y / side - 0.5, x.z / side - 0.5), 0.0, 0.0);
    };
    const glm::ivec3 n = u.cells();
    double flow = 0.0;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y) flow += u.at({n.x / 2, y, z}, 0);
    return {flow / (n.y * n.z) / unit, relative_l2(u, exact)};
}

std::vector<double> sliding_floor(Laboratory& lab) {
    Run run = lab.start();
    run.step_to_end();
    const Scene& scene = lab.scene();
    const double speed = scene.tank.walls.y_low.velocity_m_s->evaluate({}, 0.0).x;
    const double depth =
        2.0 * std::sqrt(scene.fluid.viscosity_pa_s / scene.fluid.density_kg_m3 * run.time_s());
    return {relative_l2(run.velocity(), [&](const glm::dvec3& x) {
        return glm::dvec3(speed * std::erfc(x.y / depth), 0.0, 0.0);
    })};
}

}  // namespace

std::vector<Case> viscous_flow_cases() {
    return {{.name = "A12-duct",
             .title = "flow through a square duct, in units of G H^2 / mu",
             .scene = "validation/A12-duct",
             .quick = {16, 32},
             .full = {16, 32, 64},
             .quantities = {{.name = "mean speed",
                             .exact = 0.0351443,
                             .source = "series solution, White, Viscous Fluid Flow",
                             .error = Quantity::Error::Relative,
                             .limits = {{32, 0.01}},
                             .least_order = 1.8},
                            {.name = "L2 error of u", .source = "the same series", .least_order = 1.8}},
             .measure = duct},
            {.name = "A12-wall",
             .title = "Stokes' first problem: a floor that begins to slide, dt ~ h^2",
             .scene = "validation/A12-wall",
             .time_step = TimeStep::Diffusion,
             .quick = {16, 32},
             .full = {16, 32, 64},
             .quantities = {{.name = "L2 error of u",
                             .source = "erfc(y / (2 sqrt(nu t)))",
                             .limits = {{32, 0.02}},
                             .least_order = 1.8}},
             .measure = sliding_floor}};
}

}  // namespace eddy::accuracy
