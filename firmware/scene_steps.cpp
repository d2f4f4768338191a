#include "firmware/scene_steps.h"

#include "firmware/fluid_setup.h"
#include "gles/fluid/results.h"

namespace eddy {

SceneSteps::SceneSteps(gles::Gpu& gpu, const Scene& scene)
    : motions_(scene),
      fluid_(gles::make_fluid(gpu, fluid_setup(scene))),
      dt_s_(scene.solver.dt_s),
      answers_(!fluid_->setup().imposed && gles::Results::measures(fluid_->setup())) {}

void SceneSteps::take(bool diagnose) {
    fluid_->step(dt_s_, motions_.at(static_cast<double>(fluid_->steps() + 1) * dt_s_, dt_s_), diagnose);
}

std::optional<gles::StepResult> SceneSteps::wait() {
    if (answers_) return fluid_->wait_result();
    return fluid_->result(true);
}

}  // namespace eddy
