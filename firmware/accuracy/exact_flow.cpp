#include <array>
#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"

// A3   Ethier and Steinman 1994: an exact solution in three dimensions, its velocity given on all walls.
// A4   A flow that somebody thought up (Roache 2002), held by the force that makes it a solution, in a no-slip box.
//
// Their velocities are in their scenes, as formulas of place and time: what the fluid starts with is what it should be at any
// time. Their pressures are here; density is 1.

namespace eddy::accuracy {
namespace {

using PressureFormula = std::function<double(const glm::dvec3& place_m, double t_s)>;

constexpr double kPi = std::numbers::pi;

double ethier_steinman(const glm::dvec3& place_m, double t) {
    constexpr double a = kPi / 4.0, d = kPi / 2.0;
    const auto [x, y, z] = std::array{place_m.x - 1.0, place_m.y - 1.0, place_m.z - 1.0};
    const double squares = std::exp(2.0 * a * x) + std::exp(2.0 * a * y) + std::exp(2.0 * a * z);
    const double products = std::sin(a * x + d * y) * std::cos(a * z + d * x) * std::exp(a * (y + z)) +
                            std::sin(a * y + d * z) * std::cos(a * x + d * y) * std::exp(a * (z + x)) +
                            std::sin(a * z + d * x) * std::cos(a * y + d * z) * std::exp(a * (x + y));
    return -0.5 * a * a * (squares + 2.0 * products) * std::exp(-2.0 * d * d * t);
}

double manufactured(const glm::dvec3& x, double t) {
    return std::cos(kPi * x.x) * std::cos(kPi * x.y) * std::cos(kPi * x.z) * std::sin(t);
}

/// rms of p - exact over the cells, both from their means, for a pressure in closed walls knows no constant; over the
/// pressure that stops the fastest fluid, rho U^2 / 2.
double pressure_error(const Run& run, const PressureFormula& exact) {
    const std::vector<float> p = run.fluid().pressure();
    const glm::ivec3 n = run.setup().cells;
    double sum = 0.0, squares = 0.0;
    for (int z = 0, i = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x, ++i) {
                const glm::dvec3 middle = run.setup().cell_m * (glm::dvec3(x, y, z) + 0.5);
                const double error =
                    static_cast<double>(p[static_cast<std::size_t>(i)]) - exact(middle, run.time_s());
                sum += error;
                squares += error * error;
            }
    const double count = n.x * n.y * n.z, fastest = run.velocity().fastest_m_s();
    return std::sqrt(squares / count - sum * sum / (count * count)) /
           (0.5 * run.setup().density_kg_m3 * fastest * fastest);
}

std::vector<double> errors(Laboratory& lab, const PressureFormula& pressure) {
    Run run = lab.start();
    run.step_to_end();
    const FormulaVector& u = lab.scene().initial.velocity_m_s;
    const double t = run.time_s();
    return {relative_l2(run.velocity(), [&](const glm::dvec3& x_m) { return u.evaluate(x_m, t); }),
            pressure_error(run, pressure)};
}

Case refined(const std::string& family, const std::string& title, const PressureFormula& pressure,
             const std::string& source) {
    return {.name = family + "-refined",
            .title = title + ", dt ~ h^2",
            .scene = "validation/" + family,
            .time_step = TimeStep::Diffusion,
            .quick = {16, 32},
            .full = {16, 32, 64},
            .quantities = {{.name = "L2 error of u", .source = source, .least_order = 1.8},
                           {.name = "rms error of p / (rho U^2 / 2)", .source = source}},
            .measure = [pressure](Laboratory& lab) { return errors(lab, pressure); }};
}

/// The same with steps as long as half a cell's crossing.
Case at_courant(Case one, const std::string& family, const std::string& dt_s) {
    one.name = family + "-courant";
    one.title = "the same at Courant number 0.5";
    one.set = {"solver.dt_s=" + dt_s};
    one.time_step = TimeStep::Courant;
    one.full = {16, 32, 64, 96};
    for (Quantity& quantity : one.quantities) quantity.least_order.reset();
    return one;
}

}  // namespace

std::vector<Case> exact_flow_cases() {
    const Case twisted = refined("A3", "exact flow through all walls of a cube", ethier_steinman,
                                 "exact solution, Ethier and Steinman 1994");
    const Case made = refined("A4", "manufactured flow in a no-slip cube", manufactured,
                              "the solution that the force was made for");
    return {twisted, at_courant(twisted, "A3", "0.02"), made, at_courant(made, "A4", "0.01")};
}

}  // namespace eddy::accuracy
