#pragma once
#include <string>

#include "gles/yang2009/halving_sum.h"

namespace eddy::gles {

/// Adds up a grid stored as Cells on the CPU: reads all of it back, waiting for the GPU, and goes through it
/// cell by cell. What Yang et al. 2009 (section IV-C, figures 8 to 10) compare HalvingSum with.
class LinearSum {
  public:
    /// `target_width`: texels of the row that takes the result.
    LinearSum(Gpu& gpu, const std::string& name, const glm::ivec3& cells, int target_width);
    /// Writes the sum to texel `to` of `target`.
    void draw(const Texture& source, const Texture& target, int to);

  private:
    AtlasLayout layout_;
    Field<Cells> total_;  ///< one cell
    HalvingSum place_;    ///< of that one cell: puts it into the row
};

}  // namespace eddy::gles
