#pragma once
#include "gles/reduce.h"

namespace eddy::gles {

/// Adds up a figure of each texel of a field: a shader goes through RUN texels of a row each, few enough that a graphics card has
/// all its lanes at work, and a Reduce through what it wrote.
class RowSum {
  public:
    /// `texels`: of the field, of which rows go along x; `target`, `mask`: see Reduce.
    RowSum(Gpu& gpu, const std::string& name, std::string_view shader, const glm::ivec3& texels,
           Variant variant, const glm::ivec2& target = {1, 1}, const std::string& mask = "");
    /// Writes the result to texel `to` of `target`.
    void draw(const std::vector<Input>& inputs, const std::vector<Uniform>& uniforms, const Texture& target,
              const glm::ivec2& to = {0, 0});

  private:
    Gpu* gpu_;
    AtlasLayout runs_;
    Pass look_;
    Reduce sum_;
};

}  // namespace eddy::gles
