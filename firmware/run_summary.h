#pragma once
#include "firmware/exhibit/act.h"
#include "firmware/exhibit/hand_side.h"
#include "firmware/graphics.h"
#include "firmware/recorder.h"
#include "firmware/status.h"

namespace eddy {

/// How long a run was: the show and the hand's loop by the clock that they ran on, and the show by the machine's.
struct RunLength {
    const char* clock = "real";
    double show_s = 0.0, hand_s = 0.0, wall_s = 0.0;
};

/// What status.json says of these; what concerns the box on the floor is left out.
Status status_of(const Act& act, const Graphics& graphics, const HandSide& hand);

/// Ten lines on standard output about a run that has ended. `recorder` may be null.
void print_summary(const RunLength& length, const Act& act, const Graphics& graphics, const HandSide& hand,
                   const Recorder* recorder);

}  // namespace eddy
