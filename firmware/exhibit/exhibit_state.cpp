#include "firmware/exhibit/exhibit_state.h"

namespace eddy {
namespace {

bool hand_is_missing(const ExhibitFacts& f) {
    return f.has_device && f.device != HapticState::Ready;
}

/// The force is away for a reason that does not pass by itself.
bool force_is_off(const ExhibitFacts& f) {
    return f.has_device && (f.force == GateReason::DeviceSilent || f.force == GateReason::NotFinite);
}

}  // namespace

bool is_ready(const FirstPicture& p) {
    return p.shown || !p.has_screen || !p.open || p.played >= kPictureWait;
}

ExhibitState exhibit_state(const ExhibitFacts& f) {
    if (!f.first_frame) return ExhibitState::Starting;
    if (f.safe) return ExhibitState::Safe;
    if (!f.open) return ExhibitState::Closed;
    if (f.device == HapticState::Fault && f.has_device) return ExhibitState::Fault;
    if (hand_is_missing(f) || force_is_off(f) || !f.has_screen || f.button_stuck || f.fell_back ||
        f.files_wait || f.force == GateReason::Stopped)
        return ExhibitState::Degraded;
    return f.presence == Presence::Nobody ? ExhibitState::Attract : ExhibitState::InUse;
}

LampCode lamp_code(const ExhibitFacts& f) {
    if (f.first_frame && f.force == GateReason::Stopped) return LampCode::Stopped;
    switch (exhibit_state(f)) {
        case ExhibitState::Starting:
            return LampCode::Starting;
        case ExhibitState::Attract:
            return LampCode::Attract;
        case ExhibitState::InUse:
            return f.force == GateReason::Open ? LampCode::HandOn : LampCode::Show;
        case ExhibitState::Closed:
            return LampCode::Closed;
        case ExhibitState::Degraded:
            return LampCode::Degraded;
        case ExhibitState::Fault:
        case ExhibitState::Safe:
            break;
    }
    return LampCode::Fault;
}

}  // namespace eddy
