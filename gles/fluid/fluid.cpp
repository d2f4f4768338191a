#include "gles/fluid/fluid.h"

#include <stdexcept>

#include "gles/fluid/cut_cell.h"
#include "gles/fluid/imposed.h"
#include "gles/yang2009/yang2009.h"

namespace eddy::gles {

std::unique_ptr<Fluid> make_fluid(Gpu& gpu, const FluidSetup& setup) {
    if (setup.imposed) return std::make_unique<ImposedFluid>(gpu, setup);
    if (setup.solver.method == Method::Yang2009) return std::make_unique<Yang2009Fluid>(gpu, setup);
    return std::make_unique<CutCellFluid>(gpu, setup);
}

void Fluid::take_over(const Fluid& from) {
    if (&from == this) return;
    const glm::dvec3 size = setup_.cell_m * glm::dvec3(setup_.cells);
    const glm::dvec3 other = from.setup_.cell_m * glm::dvec3(from.setup_.cells);
    if (glm::any(glm::greaterThan(glm::abs(size - other), 1e-6 * size)) ||
        setup_.bodies.size() != from.setup_.bodies.size() ||
        setup_.imposed.has_value() != from.setup_.imposed.has_value())
        throw std::logic_error(
            "a fluid was told to take over one of another tank, with other bodies, or imposed as it is not");
    bodies_ = from.bodies_;
    resume(from.state());
}

StepResult Fluid::wait_result() {
    if (auto oldest = result(true)) return *std::move(oldest);
    throw GlError("the GPU has stopped answering; nothing came back for a step");
}

}  // namespace eddy::gles
