#pragma once
#include <vector>

#include "gles/fluid/setup.h"
#include "gles/gpu.h"

namespace eddy::gles {

/// A value for each of the three lower faces of each cell, in the order of Fluid::velocity().
struct OnFaces {
    glm::ivec3 cells;
    std::vector<glm::dvec3> values;

    std::size_t index(const glm::ivec3& c) const {
        return static_cast<std::size_t>((c.z * (cells.y + 1) + c.y) * (cells.x + 1) + c.x);
    }
};

/// The fluid's share of every face as the solver sees it, with the bodies at these states; 0 on the tank's walls.
OnFaces face_shares(Gpu& gpu, const FluidSetup& setup, const std::vector<BodyState>& states);

/// sum a u over all faces, component by component.
glm::dvec3 sum(const OnFaces& a, const std::vector<glm::vec3>& u);
/// sum a u^2 over all faces.
double sum_of_squares(const OnFaces& a, const std::vector<glm::vec3>& u);

}  // namespace eddy::gles
