#pragma once
#include <vector>

#include "gles/body/fractions.h"
#include "gles/pass.h"

namespace eddy::gles {

/// How firmly the bodies' surfaces hold a viscous fluid, face by face, on each grid of the viscous solver: what
/// no slip on a surface that lies anywhere between the faces comes to (grip.frag).
class Grip {
  public:
    struct Level {
        Field<Faces> distances;  ///< signed, of each face to the nearest body [cells of this grid]
        Field<Faces> shares;     ///< of fluid in the cell around each face
        Field<Faces> grips;      ///< w: friction is nu w (u_surface - u) / h^2
    };

    /// `grids`: cells of each level, finest first.
    Grip(Gpu& gpu, const std::vector<glm::ivec3>& grids, const std::vector<BodySetup>& bodies);

    /// Draws the bodies where they are now; `boxes` hold each body and two cells around it, `fractions` is
    /// the finest grid's.
    void update(const BodyUniforms& bodies, const std::vector<Box>& boxes, const FaceFractions& fractions);

    const Level& level(std::size_t l) const { return levels_[l]; }
    /// Faces of level l that a body may hold.
    const std::vector<Box>& boxes(std::size_t l) const { return boxes_[l]; }
    /// The bodies' velocity where they hold a face of the finest grid [m/s].
    const Field<Faces>& surface() const { return surface_; }

  private:
    std::vector<glm::ivec3> grids_;
    std::vector<Level> levels_;
    Field<Faces> surface_;
    std::vector<Pass> draw_distances_, draw_grips_;
    std::vector<std::vector<Box>> boxes_;
    std::vector<Box> before_;
    bool drawn_ = false;
};

}  // namespace eddy::gles
