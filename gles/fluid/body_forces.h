#pragma once
#include <optional>

#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// What pushes the fluid everywhere at once: gravity, with the weight of smoke and the lift of heat; the scene's own force;
/// vorticity confinement.
class BodyForces {
  public:
    BodyForces(Gpu& gpu, const FluidSetup& setup);
    /// Whether the scene has any.
    static bool needed(const FluidSetup& setup);

    /// u + dt (g (1 + w s - beta T) + f). `smoke` and `temperature`: null where the scene has none. `time_s`: of f.
    /// `driven_m_s`: see Driven.
    Field<Faces> add_to(const Field<Faces>& u, const Field<Cells>* smoke, const Field<Cells>* temperature,
                        double driven_m_s, double time_s, double dt_s);

  private:
    /// The force of vorticity confinement.
    Field<Cells> swirl(const Field<Faces>& u, double driven_m_s);

    Gpu* gpu_;
    const FluidSetup* setup_;
    Pass add_;
    std::optional<Pass> vorticity_, confinement_;
};

}  // namespace eddy::gles
