#include "gles/fluid/fluid.h"

#include <algorithm>
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
    forget_answers();
    resume(from.state());
    taken_ = steps();
}

bool StepResult::is_sound() const {
    const auto finite = [](const Load& load) { return is_finite(load); };
    return health.texels() == 0 && std::all_of(loads.begin(), loads.end(), finite);
}

void Fluid::step(double dt_s, const std::vector<BodyState>& bodies, bool diagnose) {
    if (const auto length_s = guarded_step_s(dt_s, setup_, guards_))
        move_on(*length_s, guarded_bodies(bodies, bodies_, setup_, *length_s, guards_), diagnose);
    else
        ++again_;
}

std::optional<StepResult> Fluid::result(bool wait) {
    if (auto result = take_result(wait)) {
        if (!result->is_sound()) ++guards_.unsound_steps;  // guard unsound_steps
        last_ = result;
        taken_ = result->step;
        return result;
    }
    const bool all_taken = wait || taken_ == steps();
    if (again_ == 0 || !all_taken) return std::nullopt;
    --again_;
    return last_ ? *last_ : StepResult{.loads = std::vector<Load>(setup_.bodies.size())};
}

void Fluid::reset() {
    forget_answers();
    start_over();
    taken_ = 0;
}

void Fluid::forget_answers() {
    last_.reset();
    again_ = 0;
}

StepResult Fluid::wait_result() {
    if (auto oldest = result(true)) return *std::move(oldest);
    throw GlError("the GPU has stopped answering; nothing came back for a step");
}

}  // namespace eddy::gles
