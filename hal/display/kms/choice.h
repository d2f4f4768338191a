#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/display/kms/monitor.h"

// Which plug and which mode: pure functions of what there is and what is wished.

namespace eddy::kms {

struct Wish {
    std::string connector{};  ///< "HDMI-A-1", or "card1-HDMI-A-1"; empty: any
    std::string mode{};       ///< "1920x1080@60", "1920x1080"; empty: the monitor's own
    std::string last_used{};  ///< Monitor::id of the screen of last time; empty: none
};

/// A mode as people write it.
struct WrittenMode {
    int width = 0, height = 0;
    std::optional<double> hz{};
};
/// None if it is not written as 1920x1080 or 1920x1080@60.
std::optional<WrittenMode> parse_mode(std::string_view text);

struct ChosenMonitor {
    std::size_t index = 0;
    std::string why;
};
/// A plug that is named counts as connected when the card cannot tell; and never when it can tell that nothing is there.
/// Otherwise the screen of last time, else the first that is connected and has modes. None: there is no screen now.
std::optional<ChosenMonitor> choose_monitor(std::span<const Monitor> monitors, const Wish& wish);
/// Whether this plug is the one that is wished by name.
bool is_named(const Monitor& monitor, const std::string& connector);

struct ChosenMode {
    drmModeModeInfo mode{};
    std::string why;
};
/// In the order in which they are to be tried: the wished one, its size at the nearest rate, the monitor's preferred, 1920x1080@60,
/// 1280x720@60, 640x480. Never empty: a plug without any modes gets the last three as CEA-861 has them.
std::vector<ChosenMode> choose_modes(const Monitor& monitor, const Wish& wish);

}  // namespace eddy::kms
