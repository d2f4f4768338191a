#pragma once
#include <memory>

#include "hal/haptic/emulated/emulated_board.h"
#include "hal/haptic/emulated/hand_motion.h"
#include "hal/haptic/emulated/plant.h"
#include "hal/haptic/falcon/falcon.h"

namespace eddy::emulated {

/// What the emulated exhibit has instead of a Falcon and a visitor. As it stands: a device that runs and is
/// homed, ready about 10 ms after the first poll. board.start = Cold needs driver.firmware_image; any valid
/// boot stream will do.
struct EmulatedFalconSettings {
    FalconSettings driver;
    PlantSettings plant;
    BoardSettings board;
};

/// The Falcon driver above an emulated Falcon, whose time moves with poll(now) and whose handle this motion
/// moves.
std::unique_ptr<HapticDevice> make_emulated_falcon(std::unique_ptr<HandMotion> motion,
                                                   EmulatedFalconSettings settings = {});

}  // namespace eddy::emulated
