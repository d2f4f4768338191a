#include "firmware/stability/fields.h"

#include <algorithm>
#include <cmath>

#include "gles/grid_io.h"

namespace eddy::stability {
namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<float> values_of(const gles::Field<gles::Cells>* field) {
    if (!field) return {};
    return gles::unpack_scalars(field->texture().download(), field->layout());
}

/// Calls `each` with every velocity, each component times the share of a cell that it stands for: 0 beyond the tank.
template <class Each>
void for_each_velocity(const Tank& tank, const Fields& fields, Each each) {
    const glm::ivec3 n = tank.staggered ? tank.cells + 1 : tank.cells;
    std::size_t i = 0;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x, ++i) {
                glm::dvec3 share(1.0);
                const glm::ivec3 at(x, y, z);
                for (int c = 0; c < 3 && tank.staggered; ++c) {
                    if (at[c] == 0 || at[c] == tank.cells[c]) share[c] = 0.5;
                    for (int other = 0; other < 3; ++other)
                        if (other != c && at[other] == tank.cells[other]) share[c] = 0.0;
                }
                each(glm::dvec3(fields.velocity_m_s.at(i)), share);
            }
}

}  // namespace

Tank tank_of(const gles::FluidSetup& setup) {
    return {setup.cells, setup.cell_m, setup.density_kg_m3, setup.viscosity_pa_s,
            setup.solver.method != gles::Method::Yang2009};
}

Fields download(const gles::Fluid& fluid) {
    return {fluid.velocity(), fluid.pressure(), values_of(fluid.smoke()), values_of(fluid.temperature())};
}

long non_finite_texels(const Fields& fields) {
    long count = std::count_if(fields.velocity_m_s.begin(), fields.velocity_m_s.end(),
                               [](const glm::vec3& u) { return !is_finite(u); });
    for (const std::vector<float>* values : {&fields.pressure_pa, &fields.smoke, &fields.temperature_k})
        count += std::count_if(values->begin(), values->end(), [](float v) { return !std::isfinite(v); });
    return count;
}

double largest_speed_m_s(const Tank& tank, const Fields& fields) {
    double largest = 0.0;
    for_each_velocity(tank, fields, [&](const glm::dvec3& u, const glm::dvec3& share) {
        largest = std::max(largest, glm::length(u * glm::dvec3(glm::notEqual(share, glm::dvec3(0.0)))));
    });
    return largest;
}

double kinetic_energy_j(const Tank& tank, const Fields& fields) {
    double sum = 0.0;
    for_each_velocity(tank, fields,
                      [&](const glm::dvec3& u, const glm::dvec3& share) { sum += glm::dot(u * u, share); });
    return 0.5 * tank.density_kg_m3 * sum * tank.cell_m * tank.cell_m * tank.cell_m;
}

FieldRange range_of(const std::vector<float>& values) {
    if (values.empty()) return {};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low, *high};
}

}  // namespace eddy::stability
