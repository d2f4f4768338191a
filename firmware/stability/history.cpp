#include "firmware/stability/history.h"

#include <cmath>

namespace eddy::stability {
namespace {

/// Adds what flows through the two walls across axis c.
void add_walls(const Tank& tank, const Fields& fields, int c, History::Look& look) {
    const glm::ivec3 n = tank.cells;
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    const double area = tank.cell_m * tank.cell_m;
    for (int i = 0; i < n[a]; ++i)
        for (int j = 0; j < n[b]; ++j)
            for (const int wall : {0, n[c]}) {
                glm::ivec3 at(0);
                at[a] = i;
                at[b] = j;
                at[c] = wall;
                const auto texel = static_cast<std::size_t>(at.x + (n.x + 1) * (at.y + (n.y + 1) * at.z));
                const double in = (wall == 0 ? area : -area) * double(fields.velocity_m_s[texel][c]);
                look.in_m3_s += std::max(0.0, in);
                look.net_m3_s += in;
            }
}

}  // namespace

History::Look look_at(const Tank& tank, const Fields& fields, long step) {
    History::Look look{.step = step,
                       .speed_m_s = largest_speed_m_s(tank, fields),
                       .energy_j = kinetic_energy_j(tank, fields),
                       .pressure_pa = range_of(fields.pressure_pa),
                       .smoke = range_of(fields.smoke),
                       .temperature_k = range_of(fields.temperature_k),
                       .non_finite = non_finite_texels(fields)};
    if (tank.staggered)
        for (int c = 0; c < 3; ++c) add_walls(tank, fields, c, look);
    return look;
}

}  // namespace eddy::stability
