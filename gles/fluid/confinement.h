#pragma once
#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// Vorticity confinement: pushes around the middles of eddies what transport has smoothed away. Fedkiw, Stam, Jensen 2001,
/// SIGGRAPH, section 5.
class Confinement {
  public:
    Confinement(Gpu& gpu, const FluidSetup& setup);
    /// Whether the scene has any.
    static bool needed(const FluidSetup& setup) { return setup.confinement_1_s > 0.0; }

    /// u + dt eps h (N x w). `driven_m_s`: see Driven.
    Field<Faces> add_to(const Field<Faces>& u, double driven_m_s, double dt_s);

  private:
    Gpu* gpu_;
    double strength_1_s_;
    Pass vorticity_, force_, confine_;
};

}  // namespace eddy::gles
