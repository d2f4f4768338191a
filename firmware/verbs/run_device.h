#pragma once
#include <memory>
#include <string>

#include "firmware/verbs/verbs.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

struct RunDevice {
    std::unique_ptr<HapticDevice> device;  ///< null when there is to be none
    std::string name;
    std::string trouble{};  ///< what is wrong with it though the show can go on
};

/// The device the visitor of a run holds. `waits`: where it may be the Falcon it is, also if none is plugged in yet; else that is for
/// who asks for one. Throws InputError, with the option's name, for what cannot be;
/// but who waits goes on without a firmware image that is none.
RunDevice make_device(const RunOptions& options, const Exhibit& exhibit, bool waits = false);

}  // namespace eddy
