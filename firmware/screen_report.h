#pragma once
#include <string>

#include "hal/display/kms/card.h"
#include "hal/display/kms/choice.h"

namespace eddy {

struct ScreenReport {
    std::string text;     ///< lines
    bool usable = false;  ///< a screen can be driven, now
};

/// What a person who stands before a dark screen wants to know: cards, plugs, monitors, modes; what would be chosen, and why; who is
/// in the way. Looks only; changes nothing that is shown.
ScreenReport report_screens(kms::Machine& machine, const kms::Wish& wish);

}  // namespace eddy
