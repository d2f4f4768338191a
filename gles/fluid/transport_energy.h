#pragma once
#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/row_sum.h"

namespace eddy::gles {

/// Transport carries kinetic energy about; where no wall blows any in it makes none. MacCormack's correction and the reflection do make
/// some, a little in each step, and where there is hardly any friction nothing takes it out again: over thousands of steps eddies
/// grew tenfold. So what comes out of transport is made slower all over, just so much that it has no more energy than went in.
class TransportEnergy {
  public:
    TransportEnergy(Gpu& gpu, const FluidSetup& setup);
    /// Whether a fluid may need it: where transport makes energy, no wall brings any in, and friction is little enough.
    static bool needed(const FluidSetup& setup);

    /// Whether it does at this nu dt / h^2. From 0.001 on friction takes 1 % and more of what is as small as cells in a step;
    /// transport was seen to make 0.5 %. There the limit would only take what the flow needs later: the decay of a vortex at
    /// Re 100 (case A2) would peak 6 % too early.
    static bool acts(float diffusion_number) { return diffusion_number < 1e-3f; }

    /// `u_star`, no faster than with the energy of `before`: sum |u|^2 over the faces within the tank.
    Field<Faces> keep(Field<Faces> u_star, const Field<Faces>& before);

  private:
    Gpu* gpu_;
    RowSum sum_;
    Pass scale_;
};

}  // namespace eddy::gles
