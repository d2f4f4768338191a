#include "gles/fluid/velocity_at_start.h"

namespace eddy::gles {

std::vector<glm::vec3> velocity_at_start(const FluidSetup& setup) {
    if (!setup.velocities_at_start.empty()) return setup.velocities_at_start;
    const glm::ivec3 n = setup.cells;
    std::vector<glm::vec3> u(static_cast<std::size_t>((n.x + 1) * (n.y + 1) * (n.z + 1)), glm::vec3(0.0f));
    if (!setup.velocity_at_start) return u;
    std::size_t i = 0;
    for (int z = 0; z <= n.z; ++z)
        for (int y = 0; y <= n.y; ++y)
            for (int x = 0; x <= n.x; ++x, ++i) {
                // Beyond an upper wall: a copy of the last row before it, as velocity.glsl has it.
                const glm::dvec3 wall(x, y, z), row = glm::min(wall, glm::dvec3(n) - 1.0);
                const auto on_face = [&](const glm::dvec3& face) {
                    const glm::dvec3 corner = glm::mix(wall, row, 2.0 * face);
                    return setup.velocity_at_start(setup.cell_m * (corner + face));
                };
                u[i] = glm::vec3(on_face({0.0, 0.5, 0.5}).x, on_face({0.5, 0.0, 0.5}).y,
                                 on_face({0.5, 0.5, 0.0}).z);
            }
    return u;
}

}  // namespace eddy::gles
