#include "gles/body/displacement.h"

#include "gles/body/bounds.h"

namespace eddy::gles {

std::vector<Displacement> displacements(const FluidSetup& setup, const std::vector<BodyState>& before,
                                        const std::vector<BodyState>& now) {
    std::vector<Displacement> result;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Shape& shape = setup.bodies[i].shape;
        const glm::dvec3 middle = middle_m(shape, now[i]) / setup.cell_m;
        result.push_back({glm::vec3(middle), glm::vec3(middle - middle_m(shape, before[i]) / setup.cell_m),
                          static_cast<float>(bounding_ball(shape).radius_m / setup.cell_m)});
    }
    return result;
}

}  // namespace eddy::gles
