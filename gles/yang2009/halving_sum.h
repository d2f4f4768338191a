#pragma once
#include <vector>

#include "gles/field.h"
#include "gles/pass.h"

namespace eddy::gles {

/// Adds up a grid stored as Cells in O(log N) passes, each of which turns 2 x 2 x 2 cells into one (Yang et
/// al. 2009, figure 6). Any number of cells: what an odd edge lacks counts as zero.
class HalvingSum {
  public:
    /// `target_width`: texels of the row that takes the result.
    HalvingSum(Gpu& gpu, const std::string& name, const glm::ivec3& cells, int target_width);
    /// Writes the sum to texel `to` of `target`.
    void draw(const Texture& source, const Texture& target, int to);

  private:
    Gpu* gpu_;
    std::vector<glm::ivec3> grids_;  ///< [i] is what pass i writes; the last, 1 x 1 x 1, goes into the row
    std::vector<Pass> passes_;
};

}  // namespace eddy::gles
