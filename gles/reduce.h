#pragma once
#include <vector>

#include "gles/pass.h"

namespace eddy::gles {

/// Adds up all texels of a texture into one, in two passes of blocks (the square root of the work each), so
/// that no pass is serial. `mask`: GLSL vec4 whose 1s choose the maximum instead of the sum, channel by
/// channel.
class Reduce {
  public:
    Reduce(Gpu& gpu, const std::string& name, const glm::ivec2& source, const glm::ivec2& target,
           const std::string& mask = "");
    /// Writes the result to texel `to` of `target`.
    void draw(const Texture& source, const Texture& target, const glm::ivec2& to);

  private:
    glm::ivec2 middle_size_;
    Gpu* gpu_;
    Pass blocks_, rest_;
};

}  // namespace eddy::gles
