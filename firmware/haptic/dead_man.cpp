#include "firmware/haptic/dead_man.h"

#include "firmware/haptic/law.h"
#include "firmware/haptic/sound.h"
#include "firmware/haptic/vector.h"

namespace eddy {

GateReason DeadMan::operator()(const HapticInput& in) {
    // A button that is pressed wins over one that lets go in the same tick.
    if (in.orders.restarts != restarts_) stopped_ = false;
    restarts_ = in.orders.restarts;
    if (in.orders.stop) stopped_ = true;

    if (in.device != HapticState::Ready) felt_ = released_ = false;
    if (in.reading && is_finite(in.reading->position_m)) feel(*in.reading, in.now);
    if (stopped_) return GateReason::Stopped;
    return released_ ? GateReason::Released : GateReason::Open;
}

void DeadMan::feel(const HandleReading& reading, Instant now) {
    const double moved_m = glm::length(reading.position_m - rest_m_);
    const bool touched = !felt_ || reading.buttons != buttons_ || moved_m > (released_ ? kTakenUpM : kStillM);
    felt_ = true;
    buttons_ = reading.buttons;
    if (touched) {
        if (released_ && now - released_at_ < kFalseAlarm) ++counters_.false_alarms;
        released_ = false;
        rest_m_ = reading.position_m;
        since_ = now;
    } else if (!released_ && now - since_ >= kStillFor) {
        released_ = true;
        released_at_ = now;
        ++counters_.released;
    }
}

bool DeadMan::is_sound() const {
    using eddy::is_sound;
    return is_sound(stopped_) && is_sound(felt_) && is_sound(released_) && is_sound(since_) &&
           is_sound(released_at_);
}

}  // namespace eddy
