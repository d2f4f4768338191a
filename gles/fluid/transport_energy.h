#pragma once
#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/pass.h"
#include "gles/reduce.h"

namespace eddy::gles {

/// Transport carries kinetic energy about; in a closed tank it makes none. MacCormack's correction and the reflection do make
/// some, a little in each step, and nothing takes it out of a fluid without friction: over thousands of steps eddies grew tenfold.
/// Vorticity confinement is there to give back what transport takes, and knows no measure either. So what comes out of both is
/// made slower all over, just so much that it has no more energy than went in.
class TransportEnergy {
  public:
    TransportEnergy(Gpu& gpu, const FluidSetup& setup);
    /// Whether a fluid needs it: where either makes energy, and no wall brings any in.
    static bool needed(const FluidSetup& setup);

    /// `u_star`, no faster than with the energy of `before`: sum |u|^2 over the faces within the tank.
    Field<Faces> keep(Field<Faces> u_star, const Field<Faces>& before);

  private:
    Gpu* gpu_;
    AtlasLayout rows_;
    Pass add_up_;
    Reduce sum_;
    Pass scale_;
};

}  // namespace eddy::gles
