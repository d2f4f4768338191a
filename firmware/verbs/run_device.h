#pragma once
#include <memory>
#include <string>

#include "firmware/verbs/verbs.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

struct RunDevice {
    std::unique_ptr<HapticDevice> device;  ///< null when there is to be none
    std::string name;
};

/// The device the visitor of a run holds. Throws InputError, with the option's name, for what cannot be.
RunDevice make_device(const RunOptions& options, const Exhibit& exhibit);

}  // namespace eddy
