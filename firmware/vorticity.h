#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace eddy {

/// The velocity in the middle of each cell of an n grid, x fastest, from the one that gles::Fluid::velocity() gives: the mean
/// of two faces, or as it is.
std::vector<glm::vec3> velocity_in_cells(const std::vector<glm::vec3>& velocity_m_s, const glm::ivec3& n);

/// curl u [1/s] there, from the same velocity. Central differences over two cells, beside walls over one.
std::vector<glm::vec3> vorticity(const std::vector<glm::vec3>& velocity_m_s, const glm::ivec3& n,
                                 double cell_m);

}  // namespace eddy
