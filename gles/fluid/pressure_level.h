#pragma once
#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/row_sum.h"

namespace eddy::gles {

/// In a closed tank a pressure is known but for a constant. Where a body goes through a wall its volume is missed or is one too
/// many, no pressure solves the step, and each of its sweeps moves that constant on; a body that is partly outside feels it. So
/// the pressure that a step starts from has a mean of 0.
class PressureLevel {
  public:
    PressureLevel(Gpu& gpu, const FluidSetup& setup);
    /// Whether a scene needs it: in a closed tank with bodies.
    static bool needed(const FluidSetup& setup);

    /// phi - mean of phi, of which what is no pressure is no part: beyond `most_phi` (step_guard.h).
    Field<Cells4> put_right(const Field<Cells4>& phi, float most_phi);

  private:
    Gpu* gpu_;
    RowSum sum_;
    Pass subtract_;
};

}  // namespace eddy::gles
