#pragma once
#include "gles/body/fractions.h"
#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/row_sum.h"

namespace eddy::gles {

/// What of a pressure no flow explains. In a closed tank it is known but for a constant. Where a body goes through a wall its volume is
/// missed or is one too many, no pressure solves the step, and each of its sweeps moves that constant on; a body that is partly
/// outside feels it. So the pressure that a step starts from has a mean of 0. A pocket that a body has sealed has a constant of its
/// own beside, which stays as the last squeeze left it: a piston that stands still would be pushed until the pocket opens. So of what
/// is further from 0 than the gradients in the tank can make it, each step drops a fifth.
class PressureLevel {
  public:
    PressureLevel(Gpu& gpu, const FluidSetup& setup);
    /// What is no pressure, beyond `most_phi` (step_guard.h), has no part in it. `a`: the fluid's shares of the finest grid's faces.
    Field<Cells4> put_right(const Field<Cells4>& phi, const FaceFractions& a, float most_phi);

  private:
    Gpu* gpu_;
    RowSum sums_;
    Pass put_right_;
};

}  // namespace eddy::gles
