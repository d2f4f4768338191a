#pragma once
#include "gles/fluid/setup.h"

namespace eddy {

/// What an update of several steps answers, as one step of the whole time: the mean of their loads, with the change of the
/// body's velocity over all of them. The body goes evenly through an update, so all that it takes to set it off is in the first
/// step; in the last there would be drag alone.
class UpdateAnswer {
  public:
    /// A step of dt, in which the body had this velocity, and before it that. What takes no time is no step.
    void add(const gles::Load& load, double dt_s, const glm::dvec3& velocity_m_s, const glm::dvec3& before_m_s) {
        if (!(dt_s > 0.0)) return;
        if (seconds_ == 0.0) before_m_s_ = before_m_s;
        velocity_m_s_ = velocity_m_s;
        seconds_ += dt_s;
        const double share = dt_s / seconds_;
        load_.force_n += share * (load.force_n - load_.force_n);
        load_.torque_nm += share * (load.torque_nm - load_.torque_nm);
    }
    const gles::Load& load() const { return load_; }
    double seconds() const { return seconds_; }
    const glm::dvec3& velocity_m_s() const { return velocity_m_s_; }
    glm::dvec3 mean_velocity_m_s() const { return 0.5 * (velocity_m_s_ + before_m_s_); }
    glm::dvec3 acceleration_m_s2() const { return (velocity_m_s_ - before_m_s_) / seconds_; }

  private:
    gles::Load load_{};
    double seconds_ = 0.0;
    glm::dvec3 velocity_m_s_{0.0}, before_m_s_{0.0};
};

}  // namespace eddy
