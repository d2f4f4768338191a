#include "firmware/accuracy/set_off.h"

#include "firmware/accuracy/convergence.h"
#include "firmware/accuracy/references.h"
#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "gles/body/mass_properties.h"

namespace eddy::accuracy {
namespace {

const glm::dvec3 kGained_m_s(0.001, 0.0, 0.0);  // U

Scene placed(Scene box, int place) {
    Scene::Body& ball = box.bodies.at(0);
    ball.centre_m += box.tank.cell_m() * place / SetOff::kPlaces * glm::dvec3(1.0, 0.7, 0.4);
    ball.acceleration_m_s2 = glm::dvec3(0.0);
    return box;
}

}  // namespace

glm::dvec3 SetOff::on_surface(const gles::Fluid&, const gles::StepResult& result) {
    return result.loads.at(0).force_n;
}

SetOff::SetOff(gles::Gpu& gpu, Scene box, int place, ForceOn force) : dt_s_(box.solver.dt_s), force_(force) {
    box = placed(std::move(box), place);
    fluid_ = gles::make_fluid(gpu, fluid_setup(box));
    bodies_ = BodySchedule(box).at(0.0, dt_s_);
    const double volume_m3 = gles::mass_properties(fluid_->setup().bodies[0].shape).volume_m3;
    exact_n_ = -references::kAddedMassInBox * box.fluid.density_kg_m3 * volume_m3 / dt_s_ * kGained_m_s;
}

void SetOff::step() {
    bodies_[0].velocity_m_s = static_cast<double>(steps_) * kGained_m_s;
    bodies_[0].centre_m += dt_s_ * bodies_[0].velocity_m_s;
    fluid_->step(dt_s_, bodies_, false);
    const gles::StepResult result = fluid_->wait_result();
    if (steps_ >= 2)
        error_ = worse(error_, glm::length(force_(*fluid_, result) - exact_n_) / glm::length(exact_n_));
    ++steps_;
}

}  // namespace eddy::accuracy
