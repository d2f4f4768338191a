#pragma once
#include <memory>

#include "config/exhibit.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

/// The Falcon on this machine's USB, plugged in or not. Throws InputError, with the setting's name, if its firmware
/// cannot be read or is none.
std::unique_ptr<HapticDevice> make_real_falcon(const FalconConfig& config);

}  // namespace eddy
