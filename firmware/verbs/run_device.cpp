#include "firmware/verbs/run_device.h"

#include <fmt/format.h>

#include "firmware/text_file.h"
#include "firmware/verbs/real_falcon.h"
#include "hal/haptic/emulated/make_emulated_falcon.h"
#include "hal/haptic/emulated/person_motion.h"
#include "hal/haptic/emulated/recorded_motion.h"
#include "hal/haptic/falcon/usb_link.h"

namespace eddy {
namespace {

emulated::AxisMap axes_of(const RunOptions& options) {
    try {
        return emulated::AxisMap(options.motion_axes);
    } catch (const std::invalid_argument& e) {
        throw InputError(fmt::format("--motion-axes: {}", e.what()));
    }
}

RunDevice real_hand(FalconConfig config, bool goes_on) {
    constexpr const char* kName = "Novint Falcon";
    try {
        return {make_real_falcon(config), kName};
    } catch (const InputError& e) {
        // A service that ended here would end at every start, up to safe mode; and a Falcon that kept its power needs no image.
        if (!goes_on || config.firmware.empty()) throw;
        config.firmware.clear();
        return {make_real_falcon(config), kName, e.what()};
    }
}

}  // namespace

RunDevice make_device(const RunOptions& options, const Exhibit& exhibit, bool waits) {
    HapticsChoice choice = options.haptics.value_or(exhibit.haptics);
    if (choice == HapticsChoice::None && !options.motion.empty())
        throw InputError("--motion: there is no hand to move; leave out --haptics none");
    const emulated::AxisMap axes = axes_of(options);
    if (choice == HapticsChoice::None) return {nullptr, "none"};
    const bool can_be_real = options.clock == ClockChoice::Real && options.motion.empty();
    if (choice == HapticsChoice::Auto)
        choice = can_be_real && (waits || falcon::falcon_is_plugged_in()) ? HapticsChoice::Falcon
                                                                          : HapticsChoice::Emulated;
    if (choice == HapticsChoice::Falcon) {
        if (!can_be_real)
            throw InputError(
                "--haptics falcon: a real hand follows no recording and no virtual time; leave out --motion "
                "and "
                "--clock stepped, or use --haptics emulated");
        return real_hand(exhibit.falcon, waits);
    }
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
    return {emulated::make_emulated_falcon(std::move(motion), settings), "Novint Falcon, emulated"};
}

}  // namespace eddy
