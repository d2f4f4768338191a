#pragma once
#include "gles/body/shapes.h"
#include "gles/field.h"

namespace eddy::gles {

/// What the alpha channel of the inside-outside texture holds (Yang et al. 2009, section IV-A); the same
/// numbers as in cell_types.glsl.
enum class CellType {
    Outside,      ///< fluid that touches no body
    Surrounding,  ///< fluid that shares a face with a boundary cell: here the force is taken
    Boundary,     ///< obstacle that shares a face with fluid
    Inside        ///< obstacle all around
};

/// Fills the inside-outside texture T_IO: the obstacle's velocity in rgb [m/s], the cell's type in alpha.
class Voxels {
  public:
    Voxels(Gpu& gpu, const glm::ivec3& cells, const std::vector<BodySetup>& bodies);

    /// The bodies where they are now; the whole grid, as the paper does.
    void update(const BodyUniforms& bodies);
    const Texture& texture() const { return io_.texture(); }
    AtlasLayout layout() const { return io_.layout(); }

  private:
    Field<Cells> io_;
    Pass voxelise_;
};

/// What the passes that look at T_IO are compiled with: OBSTACLES unless `voxels` is null.
Variant obstacle_variant(const Voxels* voxels);

}  // namespace eddy::gles
