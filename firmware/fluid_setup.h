#pragma once
#include "config/scene.h"
#include "gles/fluid/setup.h"

namespace eddy {

/// The fluid that a scene describes. The presets' meaning is here: fast is semi-Lagrangian, precise is MacCormack, both with
/// multigrid V-cycles, yang2009 is the paper's method with Jacobi sweeps; usual_iterations() says how many (the paper gives no
/// count: 40 is ours). Settings the scene states win over the preset's.
gles::FluidSetup fluid_setup(const Scene& scene);

}  // namespace eddy
