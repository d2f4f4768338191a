#include "firmware/scene_steps.h"

#include "firmware/fluid_setup.h"

namespace eddy {

SceneSteps::SceneSteps(gles::Gpu& gpu, const Scene& scene)
    : motions_(scene), fluid_(gles::make_fluid(gpu, fluid_setup(scene))), dt_s_(scene.solver.dt_s) {}

void SceneSteps::take(bool diagnose) {
    fluid_->step(dt_s_, motions_.at(static_cast<double>(fluid_->steps() + 1) * dt_s_, dt_s_), diagnose);
}

gles::StepResult SceneSteps::wait() {
    return fluid_->wait_result();
}

}  // namespace eddy
