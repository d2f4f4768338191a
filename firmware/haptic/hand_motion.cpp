#include "firmware/haptic/hand_motion.h"

#include "firmware/haptic/low_pass.h"
#include "firmware/haptic/sound.h"
#include "firmware/haptic/vector.h"

namespace eddy {

bool HandMotion::take(const HandleReading& reading) {
    const Seconds dt = taken_at_ ? Seconds(reading.taken_at - *taken_at_) : Seconds{0.0};
    glm::dvec3 velocity = velocity_m_s_;
    if (dt.count() > 0.0) {
        // Two replies that arrive bunched make a wild difference quotient, but the weight shrinks with dt as
        // well: one step never adds more than 2 pi f times the distance moved.
        const glm::dvec3 difference = (reading.position_m - position_m_) / dt.count();
        velocity += low_pass_weight(kVelocityCutoffHz, dt) * (difference - velocity);
    }
    if (!is_finite(reading.position_m) || !is_finite(velocity)) return false;

    velocity_m_s_ = velocity;
    position_m_ = reading.position_m;
    taken_at_ = reading.taken_at;
    return true;
}

void HandMotion::forget() {
    velocity_m_s_ = glm::dvec3(0.0);
    taken_at_.reset();
}

bool HandMotion::is_sound() const {
    return eddy::is_sound(taken_at_) && (!taken_at_ || eddy::is_sound(*taken_at_));
}

}  // namespace eddy
