#pragma once
#include <vector>

#include "gles/body/shapes.h"
#include "gles/field.h"
#include "gles/pass.h"

namespace eddy::gles {

/// The fluid's share of the staggered cell around every face of one grid, axis by axis.
struct FaceFractions {
    Field<Faces4> x, y, z;

    /// ax, ay, az of the shaders.
    std::vector<Input> inputs() const;
    /// Of the three lower faces of each cell, x fastest, one layer more each way. Waits for the GPU.
    std::vector<glm::vec3> download() const;
};

/// Whether a body is so thin that a coarse grid may hold it in another place than the finest does. A mesh, which may be thin
/// anywhere, counts if it is so everywhere.
bool any_thin_body(const std::vector<BodySetup>& bodies, double cell_m);

/// Grids whose shortest side has fewer cells than this are read as if bodies could be anywhere; larger ones only in the boxes
/// around them.
inline constexpr int kBoxedFrom = 24;

/// Face fractions on the finest grid and on the coarse grids of the pressure solver. Only the boxes where a
/// body is or was are drawn each step, and what is read everywhere; in all the rest the fractions stay 1.
class Fractions {
  public:
    /// `grids`: cells of each level, finest first.
    Fractions(Gpu& gpu, const std::vector<glm::ivec3>& grids, const std::vector<BodySetup>& bodies,
              double cell_m);

    /// Draws the bodies where they are now; `boxes` hold each body and two cells around it.
    void update(const BodyUniforms& bodies, const std::vector<Box>& boxes);

    const FaceFractions& level(std::size_t l) const { return levels_[l]; }
    bool are_thin() const { return are_thin_; }

  private:
    void draw(const BodyUniforms& bodies, const Region& finest, const std::vector<Region>& coarse);

    std::vector<glm::ivec3> grids_;
    FaceFractions volumes_;  ///< before they are sharpened
    std::vector<FaceFractions> levels_;
    Pass finest_, sharpen_;
    std::vector<Pass> coarsen_;  ///< [l] makes level l + 1 from level l
    std::vector<Box> before_;
    bool drawn_ = false, are_thin_;
};

}  // namespace eddy::gles
