#include "firmware/verbs/real_falcon.h"

#include <fmt/format.h>

#include "firmware/input_error.h"
#include "firmware/text_file.h"
#include "hal/haptic/falcon/falcon.h"
#include "hal/haptic/falcon/usb_link.h"

namespace eddy {
namespace {

std::string read_image(const std::string& file) {
    try {
        return read_text_file(file);
    } catch (const std::runtime_error& e) {
        throw InputError(fmt::format("falcon.firmware: {}", e.what()));
    }
}

}  // namespace

std::unique_ptr<HapticDevice> make_real_falcon(const FalconConfig& config) {
    FalconSettings settings{.motor_units_per_nm = config.motor_units_per_nm,
                            .flush_on_frame_end = config.event_character,
                            .keep_homing_bit = config.keep_homing_bit};
    const std::string image = config.firmware.empty() ? std::string() : read_image(config.firmware);
    settings.firmware_image.assign(image.begin(), image.end());
    try {
        return std::make_unique<Falcon>(std::make_unique<falcon::UsbLink>(config.serial),
                                        std::move(settings));
    } catch (const std::invalid_argument& e) {
        throw InputError(fmt::format("falcon.firmware: {}: {}", config.firmware, e.what()));
    } catch (const std::runtime_error& e) {
        throw InputError(fmt::format("falcon: {}", e.what()));
    }
}

}  // namespace eddy
