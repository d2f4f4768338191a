#include "hal/haptic/emulated/make_emulated_falcon.h"

#include <utility>

#include "hal/haptic/emulated/emulated_falcon.h"

namespace eddy::emulated {

std::unique_ptr<HapticDevice> make_emulated_falcon(std::unique_ptr<HandMotion> motion,
                                                   EmulatedFalconSettings settings) {
    auto device = std::make_unique<EmulatedFalcon>(std::move(motion), settings.plant, settings.board);
    return std::make_unique<Falcon>(std::move(device), std::move(settings.driver));
}

}  // namespace eddy::emulated
