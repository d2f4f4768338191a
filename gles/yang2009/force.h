#pragma once
#include <variant>
#include <vector>

#include "gles/yang2009/halving_sum.h"
#include "gles/yang2009/linear_sum.h"
#include "gles/yang2009/voxels.h"

namespace eddy::gles {

/// Force and torque of the fluid on each body as Yang et al. 2009 take them: a texture T_F over the whole
/// grid with the pressure and, in a viscous fluid, the friction on the body's faces in the surrounding cells,
/// one with its moment, and a sum of each.
class VoxelForce {
  public:
    /// Bodies that measure neither force nor torque have no passes. `target_width`: texels of the row for the
    /// results.
    VoxelForce(Gpu& gpu, const FluidSetup& setup, int target_width);

    /// Writes, for body i, the sum of T_F to texel 2i of `target` and its moment to texel 2i + 1, as far as they are asked for: in m/s
    /// cells^2 and m/s cells^3. With phi = dt p / (rho h), times rho h^3/dt and rho h^4/dt they are newtons
    /// and newton metres. `star`: u*, the velocity before the projection; `diffusion`: nu dt / h^2 (neither
    /// is used without viscosity).
    void draw(const Field<Cells>& phi, const Field<Cells>& star, float diffusion, const Voxels& voxels,
              const BodyUniforms& uniforms, const std::vector<BodyState>& states, const Texture& target);

  private:
    struct Body {
        int index;
        std::vector<int> parts;  ///< asked for
        Pass force;
    };
    Gpu* gpu_;
    double cell_m_;
    std::vector<Body> bodies_;
    std::variant<HalvingSum, LinearSum> sum_;
};

}  // namespace eddy::gles
