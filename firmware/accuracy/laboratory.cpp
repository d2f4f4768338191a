#include "firmware/accuracy/laboratory.h"

#include <algorithm>
#include <cmath>

#include "firmware/fluid_setup.h"

namespace eddy::accuracy {

using Clock = std::chrono::steady_clock;

Run::Run(gles::Gpu& gpu, const Scene& scene, std::vector<double>& step_ms, Progress& progress)
    : fluid_(gles::make_fluid(gpu, fluid_setup(scene))),
      motions_(scene),
      dt_s_(scene.solver.dt_s),
      steps_(std::lround(scene.outputs.duration_s / dt_s_)),
      step_ms_(step_ms),
      progress_(progress) {
    for (const Scene::Body& body : scene.bodies) measures_ |= body.force || body.torque;
}

gles::StepResult Run::step() {
    const Clock::time_point start = Clock::now();
    const double t = static_cast<double>(fluid_->steps() + 1) * dt_s_;
    gles::StepResult result;
    fluid_->step(dt_s_, motions_.at(t, dt_s_), diagnose_);
    if (measures_ || diagnose_)
        result = fluid_->wait_result();
    else
        gles::finish();
    step_ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    progress_.show(static_cast<double>(fluid_->steps()), static_cast<double>(steps_));
    return result;
}

gles::StepResult Run::step_to_end(const std::function<void(const gles::StepResult&)>& after_each) {
    gles::StepResult result;
    while (fluid_->steps() < steps_) {
        result = step();
        if (after_each) after_each(result);
    }
    return result;
}

double Run::time_s() const {
    return static_cast<double>(fluid_->steps()) * dt_s_;
}

Laboratory::Laboratory(gles::Gpu& gpu, Scene scene, std::string label)
    : gpu_(gpu), scene_(std::move(scene)), progress_(std::move(label)) {}

}  // namespace eddy::accuracy
