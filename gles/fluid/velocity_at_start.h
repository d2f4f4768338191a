#pragma once
#include <vector>

#include "gles/fluid/setup.h"

namespace eddy::gles {

/// The velocity that a scene starts with, on the staggered grid and in the order of Fluid::velocity().
std::vector<glm::vec3> velocity_at_start(const FluidSetup& setup);

}  // namespace eddy::gles
