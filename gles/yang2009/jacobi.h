#pragma once
#include "gles/yang2009/voxels.h"

namespace eddy::gles {

/// Solves   sum of (phi_nb - phi) = d   over the six neighbours of every fluid cell by plain Jacobi sweeps
/// from zero, as Crane, Llamas & Tariq 2007 do. phi = dt p / (rho h) [m/s]; no gradient across obstacles and
/// walls.
class Jacobi {
  public:
    /// `voxels`: null when nothing solid is in the tank. Must outlive this.
    Jacobi(Gpu& gpu, const glm::ivec3& cells, const Voxels* voxels);
    /// `sweeps`: at least 1.
    Field<Cells> solve(const Field<Cells>& d, int sweeps);

  private:
    Gpu* gpu_;
    const Voxels* voxels_;
    Field<Cells> zero_;  ///< first guess of every step
    Pass sweep_;
};

}  // namespace eddy::gles
