#include "gles/fluid/fluid.h"

#include "gles/fluid/cut_cell.h"
#include "gles/fluid/imposed.h"
#include "gles/yang2009/yang2009.h"

namespace eddy::gles {

std::unique_ptr<Fluid> make_fluid(Gpu& gpu, const FluidSetup& setup) {
    if (setup.imposed) return std::make_unique<ImposedFluid>(gpu, setup);
    if (setup.solver.method == Method::Yang2009) return std::make_unique<Yang2009Fluid>(gpu, setup);
    return std::make_unique<CutCellFluid>(gpu, setup);
}

StepResult Fluid::wait_result() {
    if (auto oldest = result(true)) return *std::move(oldest);
    throw GlError("the GPU has stopped answering; nothing came back for a step");
}

}  // namespace eddy::gles
