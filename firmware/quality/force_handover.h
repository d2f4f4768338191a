#pragma once
#include "firmware/haptic/local_model.h"
#include "gles/fluid/setup.h"
#include "hal/clock.h"

namespace eddy {

/// Lets a force go over from one fluid to another without a jump. While the new one settles, the last force of the old one goes
/// on as the body's motion changes it; what the next answer of the new one differs from that is added to its answers, less and
/// less, for half a second. How motion changes it is learned all the time: a hand that turns in those three answers changes the
/// force by more than two settings of one fluid differ.
class ForceHandover {
  public:
    static constexpr Seconds kFade{0.5};
    /// Answers that are not heeded: yang2009 sees half of any change a step late, and all of it only in the step after.
    static constexpr int kSettling = 2;

    /// How the body went in the step that gave a load.
    struct Motion {
        glm::dvec3 velocity_m_s{0.0}, acceleration_m_s2{0.0};
    };

    /// The next load is the first of another fluid.
    void begin() { settling_ = any_ ? kSettling + 1 : 0; }
    /// Loads as the fluid gives them, with growing times, and as they are handed on. One that is not finite goes through and
    /// leaves no trace.
    gles::Load hand_on(const gles::Load& load, const Motion& motion, Seconds time);

  private:
    /// As far as it is known: a hand that rests in a jet teaches nothing.
    glm::dvec3 of_motion_n(const Motion& motion) const {
        return model_.explained() * model_.force_n(motion.velocity_m_s, motion.acceleration_m_s2);
    }

    bool any_ = false;
    int settling_ = 0;   ///< answers to come before the fade goes on by itself
    gles::Load last_{};  ///< handed on,
    Motion motion_{};    ///< for this,
    Seconds time_{0.0};  ///< and then
    gles::Load difference_{};
    Seconds began_{0.0};
    LocalModel model_;
};

}  // namespace eddy
