#include "firmware/verbs/run_device.h"

#include <fmt/format.h>

#include "firmware/text_file.h"
#include "hal/haptic/emulated/make_emulated_falcon.h"
#include "hal/haptic/emulated/person_motion.h"
#include "hal/haptic/emulated/recorded_motion.h"

namespace eddy {
namespace {

emulated::AxisMap axes_of(const RunOptions& options) {
    try {
        return emulated::AxisMap(options.motion_axes);
    } catch (const std::invalid_argument& e) {
        throw InputError(fmt::format("--motion-axes: {}", e.what()));
    }
}

}  // namespace

std::unique_ptr<HapticDevice> make_device(const RunOptions& options, HapticsChoice choice) {
    if (choice == HapticsChoice::None && !options.motion.empty())
        throw InputError("--motion: there is no hand to move; leave out --haptics none");
    const emulated::AxisMap axes = axes_of(options);
    if (choice == HapticsChoice::None) return nullptr;
    if (choice == HapticsChoice::Falcon)
        throw InputError(
            "--haptics falcon: this version cannot drive a real Falcon yet; use emulated, or auto");
    emulated::EmulatedFalconSettings settings;
    std::unique_ptr<emulated::HandMotion> motion;
    if (options.motion.empty()) {
        emulated::PersonSettings person;
        person.seed = options.seed;
        motion = std::make_unique<emulated::PersonMotion>(person);
    } else {
        settings.plant.hand = emulated::Hand::OnPath;  // a recording is what a hand did, whatever it felt
        try {
            motion = std::make_unique<emulated::RecordedMotion>(read_text_file(options.motion),
                                                                options.motion, axes, emulated::AtEnd::Loop);
        } catch (const std::runtime_error& e) {
            throw InputError(fmt::format("--motion: {}", e.what()));
        }
    }
    return emulated::make_emulated_falcon(std::move(motion), settings);
}

}  // namespace eddy
