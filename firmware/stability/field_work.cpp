#include "firmware/stability/field_work.h"

#include <algorithm>
#include <cmath>

namespace eddy::stability {
namespace {

bool lets_through(const gles::WallSetup& wall) {
    return wall.kind == gles::WallKind::Inflow || wall.kind == gles::WallKind::Open;
}

std::size_t at(const glm::ivec3& n, const glm::ivec3& i) {
    return (static_cast<std::size_t>(i.z) * static_cast<std::size_t>(n.y) + static_cast<std::size_t>(i.y)) *
               static_cast<std::size_t>(n.x) +
           static_cast<std::size_t>(i.x);
}

double wall_power_w(const gles::FluidSetup& setup, const Fields& fields, int wall) {
    const glm::ivec3 n = setup.cells;
    const int axis = wall / 2, across = (axis + 1) % 3, along = (axis + 2) % 3;
    const bool high = wall % 2 == 1;
    const bool open = setup.walls[static_cast<std::size_t>(wall)].kind == gles::WallKind::Open;
    const double area_m2 = setup.cell_m * setup.cell_m;
    double power_w = 0.0;
    for (int j = 0; j < n[along]; ++j)
        for (int i = 0; i < n[across]; ++i) {
            glm::ivec3 cell(0);
            cell[axis] = high ? n[axis] - 1 : 0;
            cell[across] = i;
            cell[along] = j;
            glm::ivec3 face = cell;
            if (high) face[axis] = n[axis];
            const double inward =
                (high ? -1.0 : 1.0) * static_cast<double>(fields.velocity_m_s[at(n + 1, face)][axis]);
            if (!(inward > 0.0)) continue;
            const glm::dvec3 u(fields.velocity_m_s[at(n + 1, cell)]);
            const double pressure_pa =
                open ? 0.0 : std::abs(static_cast<double>(fields.pressure_pa[at(n, cell)]));
            const double head_pa = 0.5 * setup.density_kg_m3 * std::max(glm::dot(u, u), inward * inward);
            power_w += (pressure_pa + head_pa) * inward * area_m2;
        }
    return power_w;
}

}  // namespace

double field_work_j(const gles::FluidSetup& setup, const Fields& fields, double dt_s) {
    double power_w = 0.0;
    for (int wall = 0; wall < 6; ++wall)
        if (lets_through(setup.walls[static_cast<std::size_t>(wall)]))
            power_w += wall_power_w(setup, fields, wall);
    glm::dvec3 flux(0.0);
    for (const glm::vec3& u : fields.velocity_m_s) flux += glm::dvec3(u);
    const double volume_m3 = setup.cell_m * setup.cell_m * setup.cell_m;
    power_w += std::max(0.0, setup.density_kg_m3 * volume_m3 * glm::dot(setup.gravity_m_s2, flux));
    return dt_s * power_w;
}

double falling_speed_m_s(const gles::FluidSetup& setup) {
    const bool falls = std::any_of(setup.walls.begin(), setup.walls.end(), lets_through);
    const glm::dvec3 size_m = setup.cell_m * glm::dvec3(setup.cells);
    return falls ? std::sqrt(2.0 * glm::dot(glm::abs(setup.gravity_m_s2), size_m)) : 0.0;
}

}  // namespace eddy::stability
