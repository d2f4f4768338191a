#pragma once
#include "config/scene.h"
#include "gles/fluid/setup.h"

namespace eddy {

/// The fluid that a scene describes. The presets' meaning is here: fast is semi-Lagrangian with 2 V-cycles a
/// step, precise is MacCormack with 3, yang2009 is the paper's method with 40 Jacobi sweeps (the count is
/// ours; the paper gives none). Settings the scene states win over the preset's.
gles::FluidSetup fluid_setup(const Scene& scene);

}  // namespace eddy
