#include "firmware/scene_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "firmware/input_error.h"

namespace eddy {

int longest_side(const Scene& scene) {
    const glm::ivec3& n = scene.tank.cells;
    return std::max({n.x, n.y, n.z});
}

Scene with_longest_side(Scene scene, int cells, std::string_view asked_by) {
    const glm::dvec3& size = scene.tank.size_m;
    const glm::dvec3 n = size / (std::max({size.x, size.y, size.z}) / cells);
    scene.tank.cells = glm::ivec3(glm::round(n));
    if (glm::length(n - glm::dvec3(scene.tank.cells)) > 1e-3)
        throw InputError(
            fmt::format("{} {}: cells that many along the longest side would make {:.4g} x {:.4g} x {:.4g}; "
                        "choose a number that divides the tank into cubes",
                        asked_by, cells, n.x, n.y, n.z));
    return scene;
}

}  // namespace eddy
