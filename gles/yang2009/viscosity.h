#pragma once
#include "gles/fluid/walls.h"
#include "gles/yang2009/voxels.h"

namespace eddy::gles {

/// Lets the velocity diffuse for one step, implicitly (Stam 1999), so that no viscosity is too large: solves
/// (1 - k laplacian) u = u* by Jacobi sweeps from u*. No slip at obstacles and at walls that have
/// friction, free slip at the others.
///
/// The number of sweeps is fixed. A sweep leaves less than 6k/(1 + 6k) of the error: 20 of them leave 5 % at
/// k = 1. Where k is much larger they stop short, and the fluid seems thinner than it is: the slowest modes
/// then decay as if k were a sixth of the sweeps.
class Viscosity {
  public:
    static constexpr int kSweeps = 20;

    /// `voxels`: null when nothing solid is in the tank. Both must outlive this.
    Viscosity(Gpu& gpu, const FluidSetup& setup, const Voxels* voxels);
    /// `star`: u*, which in obstacles is the obstacle's velocity. `diffusion`: k. `time_s`: of the walls'
    /// velocity.
    Field<Cells> solve(const Field<Cells>& star, float diffusion, double time_s);

  private:
    Gpu* gpu_;
    const Voxels* voxels_;
    Walls walls_;
    Pass sweep_;
};

}  // namespace eddy::gles
