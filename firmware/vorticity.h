#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace eddy {

/// curl u [1/s] in the middle of each cell of an n grid, x fastest, from the velocity as gles::Fluid::velocity() gives
/// it. Central differences over two cells, beside walls over one.
std::vector<glm::vec3> vorticity(const std::vector<glm::vec3>& velocity_m_s, const glm::ivec3& n,
                                 double cell_m);

}  // namespace eddy
