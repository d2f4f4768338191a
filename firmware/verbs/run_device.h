#pragma once
#include <memory>

#include "firmware/verbs/verbs.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

/// The device the visitor of a run holds; null when there is to be none. Throws InputError, with the option's name, for what
/// cannot be.
std::unique_ptr<HapticDevice> make_device(const RunOptions& options, HapticsChoice choice);

}  // namespace eddy
