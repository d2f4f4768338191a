#pragma once
#include "gles/fluid/fluid.h"

namespace eddy::gles {

/// What lives in a fluid from step to step.
FluidState inside(const Fluid& fluid);

/// Puts a value into one texel of a field, in all its channels, as a fault in memory would.
void poison(const Texture& texture, const glm::ivec2& texel, float value);

/// Numbers of a texture that are not finite.
long not_finite(const Texture& texture);
/// The same of everything that lives in a fluid.
long not_finite(const Fluid& fluid);

}  // namespace eddy::gles
