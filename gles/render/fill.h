#pragma once
#include "gles/gpu.h"

namespace eddy::gles {

/// Makes a rectangle of a picture one colour, opaque, without any shader; `low` is its lower left corner, for the first row is at the
/// bottom. What reaches past the picture is cut.
void fill(Gpu& gpu, const Texture& picture, const glm::ivec2& low, const glm::ivec2& size,
          const glm::vec3& colour);

}  // namespace eddy::gles
