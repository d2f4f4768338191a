#pragma once
#include <optional>
#include <vector>

#include "gles/body/fractions.h"
#include "gles/fluid/no_limit.h"
#include "gles/fluid/walls.h"

namespace eddy::gles {

/// Between the velocities on faces and the pressures in cells: divergence, and the gradient taken off. Both are drawn over
/// the whole grid as if nothing solid were in it, then again, with the fluid's share of each face, over the boxes around
/// bodies.
class Projection {
  public:
    /// `fractions`: null when nothing solid is in the tank. All but `setup` must outlive this.
    Projection(Gpu& gpu, const FluidSetup& setup, const Walls& walls, const Fractions* fractions,
               const BodyUniforms& bodies);

    /// div (a u + (1 - a) u_solid), of which a cell is asked no more than its openings let through. `boxes`: around the bodies;
    /// `wall_time`: see Walls.
    Field<Cells4> divergence(const Field<Faces>& u, double through_gaps_m_s, const std::vector<Box>& boxes,
                             const Uniform& wall_time);
    struct Limits {
        float most_phi = kNoLimit;           ///< of a phi of the last step; see kept() in guard.glsl
        double through_gaps_m_s = kNoLimit;  ///< see Driven
    };
    /// u - scale grad phi, and on walls and in solids their velocity. Where there is no viscous step that would start with the
    /// pressure of the last one, phi is always this step's and `scale` must be 1: the shader has none.
    Field<Faces> project(const Field<Faces>& u, const Field<Cells4>& phi, float scale, const Limits& limits,
                         const std::vector<Box>& boxes, const Uniform& wall_time);

  private:
    /// What passes near solids read besides their own.
    void add_solids(std::vector<Input>& inputs, std::vector<Uniform>& uniforms) const;

    Gpu* gpu_;
    const Fractions* fractions_;
    const BodyUniforms* bodies_;
    bool predicts_;
    Pass divergence_, project_;
    std::optional<Pass> divergence_cut_, project_cut_;
    std::optional<Pass> project_at_walls_;  ///< of which any lets fluid through
};

}  // namespace eddy::gles
