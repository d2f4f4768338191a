#include "hal/display/display.h"

namespace eddy {

const char* to_string(DisplayState state) {
    switch (state) {
        case DisplayState::Showing:
            return "showing";
        case DisplayState::NoMonitor:
            return "no monitor";
        case DisplayState::Asleep:
            return "asleep";
        case DisplayState::Moved:
            return "moved";
        case DisplayState::Lost:
            return "lost";
    }
    return "unknown";
}

}  // namespace eddy
