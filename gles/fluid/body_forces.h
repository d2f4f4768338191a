#pragma once
#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// What pushes the fluid everywhere at once: gravity, with the weight of smoke and the lift of heat; the scene's own force.
class BodyForces {
  public:
    BodyForces(Gpu& gpu, const FluidSetup& setup);
    /// Whether the scene has any.
    static bool needed(const FluidSetup& setup);

    /// u + dt (g (1 + w s - beta T) + f). `smoke` and `temperature`: null where the scene has none. `time_s`: of f.
    Field<Faces> add_to(const Field<Faces>& u, const Field<Cells>* smoke, const Field<Cells>* temperature,
                        double time_s, double dt_s);

  private:
    Gpu* gpu_;
    const FluidSetup* setup_;
    Pass add_;
};

}  // namespace eddy::gles
