#include "firmware/haptic_study/study_fluid.h"

#include <algorithm>

namespace eddy::haptic_study {

HapticOrders KnownFluid::orders() const {
    return {.enabled = true, .lowest_m = glm::dvec3(-0.05), .highest_m = glm::dvec3(0.05)};
}

namespace {

/// No hand of the study goes faster.
constexpr double kFastestM_s = 3.0;

}  // namespace

void KnownFluid::update(Instant now, Seconds dt) {
    const PoseSnapshot& pose = exchange.pose.newest();
    const glm::dvec3 position_m = path_.at(pose, now, kFastestM_s);
    const glm::dvec3 velocity_m_s =
        placed_ && pose.known ? (position_m - position_m_) / dt.count() : glm::dvec3(0.0);
    const glm::dvec3 acceleration_m_s2 = (velocity_m_s - velocity_m_s_) / dt.count();
    const glm::dvec3 force_n =
        settings_.push_n - settings_.drag_ns_m * velocity_m_s - settings_.added_kg * acceleration_m_s2;
    under_way_ = {.force_n = force_n,
                  .sequence = under_way_.sequence + 1,
                  .computed_for = pose.time,
                  .fluid_period = dt,
                  .velocity_m_s = velocity_m_s,
                  .acceleration_m_s2 = acceleration_m_s2,
                  .received_j = under_way_.received_j -
                                glm::dot(force_n, 0.5 * (velocity_m_s + velocity_m_s_)) * dt.count()};
    velocity_m_s_ = velocity_m_s;
    if (pose.known) {
        position_m_ = position_m;
        placed_ = true;
    }
}

void KnownFluid::publish() {
    if (under_way_.sequence == done_.sequence) return;
    done_ = under_way_;
    exchange.fluid.publish(done_);
}

SceneFluid::SceneFluid(gles::Gpu& gpu, const Scene& scene, const FluidSlopes& slopes, Seconds period)
    : show_(gpu, scene, exchange), orders_(orders_for(scene, show_.fluid().setup())) {
    orders_.gain = std::min(orders_.gain, most_gain(slopes, orders_.tank_from_device.scale, period));
}

void SceneFluid::update(Instant now, Seconds dt) {
    constexpr long kDiagnoseEvery = 20;  // as eddy run does
    show_.update(now, dt, updates_++ % kDiagnoseEvery == 0);
}

}  // namespace eddy::haptic_study
