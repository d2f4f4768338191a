#pragma once
#include <vector>

#include "gles/fluid/setup.h"

namespace eddy::gles {

/// Where a body is and how far it came since the last step, in cells.
struct Displacement {
    glm::vec3 centre, moved;
    float radius;  ///< of the ball around that centre that holds it
};

/// Of each body; none before the first step, where `before` is empty.
std::vector<Displacement> displacements(const FluidSetup& setup, const std::vector<BodyState>& before,
                                        const std::vector<BodyState>& now);

}  // namespace eddy::gles
