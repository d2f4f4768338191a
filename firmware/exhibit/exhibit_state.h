#pragma once
#include "firmware/exhibit/lamps.h"
#include "firmware/exhibit/visitors.h"
#include "firmware/exhibit/vital_signs.h"
#include "firmware/haptic/exchange.h"

namespace eddy {

/// What there is to know of the exhibit at a glance.
struct ExhibitFacts {
    bool first_frame = false;  ///< there was one
    bool open = true;          ///< by its opening hours
    bool safe = false;         ///< safe mode
    bool has_device = false;   ///< somebody is to hold something
    HapticState device = HapticState::Absent;
    GateReason force = GateReason::Open;
    Presence presence = Presence::Nobody;
    bool has_screen = true;     ///< it has one, or is not to have one
    bool button_stuck = false;  ///< or a line of the panel is away, or all of it hangs
    bool fell_back =
        false;  ///< it runs with other settings than those in its folder: older ones, or the factory's
    bool files_wait = false;  ///< what the disk does not read or keep
};

/// How far the first picture of the show has come.
struct FirstPicture {
    bool shown = false;       ///< it is on the screen
    bool has_screen = false;  ///< there is one to put it on
    bool open = true;         ///< by the opening hours
    Instant played{0};        ///< the show has gone on for so long
};
/// A screen that takes no picture for so long is somebody else's, or dark: nobody waits for it.
inline constexpr Instant kPictureWait = std::chrono::seconds(2);
/// Pure: whether the service is ready: the first picture is seen, or there is nothing to see it on, or none is wanted.
bool is_ready(const FirstPicture& picture);

/// Pure: the state for status.json, metrics and people far away.
ExhibitState exhibit_state(const ExhibitFacts& facts);
/// Pure: the code for the lamps, between news that are shown for a moment.
LampCode lamp_code(const ExhibitFacts& facts);

}  // namespace eddy
