#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "config/value.h"
#include "firmware/exhibit/frame_times.h"
#include "firmware/exhibit/usage.h"

namespace eddy {

/// What the exhibit is doing, as lamps, status.json and metrics say it.
enum class ExhibitState : std::uint8_t { Starting, Attract, InUse, Closed, Degraded, Fault, Safe };

inline constexpr Word<ExhibitState> kExhibitStates[] = {
    {ExhibitState::Starting, "starting", "not yet the first frame"},
    {ExhibitState::Attract, "attract", "open, nobody at the handle"},
    {ExhibitState::InUse, "in_use", "somebody at the handle"},
    {ExhibitState::Closed, "closed", "outside the opening hours: no picture, no force"},
    {ExhibitState::Degraded, "degraded",
     "a show, but not all of it: no device or screen, a line of the panel away, other settings, or force "
     "off"},
    {ExhibitState::Fault, "fault", "the haptic device has given up: a show without a hand"},
    {ExhibitState::Safe, "safe", "safe mode: factory settings, no force"},
};
constexpr std::span<const Word<ExhibitState>> words_of(ExhibitState) {
    return kExhibitStates;
}

/// How the exhibit fares as a box on a floor, beside what its fluid and its hand do (Status).
struct VitalSigns {
    ExhibitState state = ExhibitState::Starting;
    std::string opening{};  ///< "open until Tuesday 17:00"
    bool clock_synchronised = false;
    FrameTimes frames{};
    Usage total{}, today{};
    bool config_good = true;       ///< the last that was read was taken
    double config_taken_at_s = 0;  ///< when one was last taken, UTC since 1970; 0: never
    std::string config_hash{};
    std::uint64_t gpu_resets = 0;
    std::uint64_t disk_errors = 0;  ///< times that something could not be written
    std::optional<double> temperature_c{};
};

/// The hottest of the machine's own thermometers; none if it has none. `folder`: /sys/class/thermal.
std::optional<double> temperature_c(const std::filesystem::path& folder = "/sys/class/thermal");

}  // namespace eddy
