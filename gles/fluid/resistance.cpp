#include "gles/fluid/resistance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gles/body/bounds.h"
#include "gles/body/mass_properties.h"

namespace eddy::gles {
namespace {

/// From a body to the nearest wall, and from the ball that holds it to that of the nearest other body; at least one cell.
double room_m(const FluidSetup& setup, const std::vector<BodyState>& states, std::size_t body) {
    const Shape& shape = setup.bodies[body].shape;
    const Extent reach = extent(shape, states[body].orientation);
    const glm::dvec3& here = states[body].centre_m;
    const glm::dvec3 to_walls =
        glm::min(here + reach.low, setup.cell_m * glm::dvec3(setup.cells) - here - reach.high);
    double room = std::min({to_walls.x, to_walls.y, to_walls.z});
    const double radius = bounding_ball(shape).radius_m;
    for (std::size_t i = 0; i < setup.bodies.size(); ++i) {
        if (i == body) continue;
        const Shape& other = setup.bodies[i].shape;
        const double far = glm::distance(middle_m(shape, states[body]), middle_m(other, states[i]));
        const double radius_of_other = bounding_ball(other).radius_m;
        room = std::min(
            room, (setup.bodies[i].inside_out ? radius_of_other - far : far - radius_of_other) - radius);
    }
    return std::max(room, setup.cell_m);
}

}  // namespace

double resistance_1_s(const FluidSetup& setup, const std::vector<BodyState>& states, std::size_t body,
                      bool turns, double dt_s) {
    if (setup.viscosity_pa_s == 0.0) return 0.0;
    const double a = std::cbrt(0.75 / std::numbers::pi * mass_properties(setup.bodies[body].shape).volume_m3);
    const double nu = setup.viscosity_pa_s / setup.density_kg_m3;
    const double layer = 2.0 * a / std::sqrt(std::numbers::pi * nu * dt_s);
    const double stokes =
        turns ? 15.0 * (1.0 + layer / 3.0) : 4.5 * (1.0 + layer + a / room_m(setup, states, body));
    return 1.5 * nu / (a * a) * stokes;
}

}  // namespace eddy::gles
