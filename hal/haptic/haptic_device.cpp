#include "hal/haptic/haptic_device.h"

namespace eddy {

const char* to_string(HapticState state) {
    switch (state) {
        case HapticState::Absent:
            return "absent";
        case HapticState::Booting:
            return "booting";
        case HapticState::Loading:
            return "loading";
        case HapticState::Homing:
            return "homing";
        case HapticState::Ready:
            return "ready";
        case HapticState::Fault:
            return "fault";
    }
    return "unknown";
}

}  // namespace eddy
