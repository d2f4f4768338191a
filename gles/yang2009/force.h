#pragma once
#include <vector>

#include "gles/yang2009/halving_sum.h"
#include "gles/yang2009/voxels.h"

namespace eddy::gles {

/// Force and torque of the pressure on each body as Yang et al. 2009 take them: a texture T_F over the whole
/// grid with -p n dA in the surrounding cells, one with its moment, and a parallel sum of each.
class VoxelForce {
  public:
    /// Bodies that measure neither force nor torque have no passes. `target_width`: texels of the row for the
    /// results.
    VoxelForce(Gpu& gpu, const glm::ivec3& cells, double cell_m, const std::vector<BodySetup>& bodies,
               int target_width);

    /// Writes, for body i, the sum of T_F to texel 2i of `target` and its moment to texel 2i + 1: in m/s
    /// cells^2 and m/s cells^3. With phi = dt p / (rho h), times rho h^3/dt and rho h^4/dt they are newtons
    /// and newton metres.
    void draw(const Field<Cells>& phi, const Voxels& voxels, const BodyUniforms& uniforms,
              const std::vector<BodyState>& states, const Texture& target);

  private:
    Gpu* gpu_;
    double cell_m_;
    std::vector<int> measured_;  ///< numbers of the bodies
    Pass force_;
    HalvingSum sum_;
};

}  // namespace eddy::gles
