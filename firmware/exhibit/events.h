#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace eddy {

/// What the log speaks of: one kind for each thing that somebody may want to look for, or be woken by.
enum class Event : std::uint8_t {
    Started,
    FirstPicture,
    Ready,
    Stopping,
    EndedBadly,
    PowerCut,
    SafeMode,
    Crashed,
    Hangs,
    Opened,
    Closed,
    ClockUnsure,
    VisitBegan,
    VisitEnded,
    Reset,
    ConfigTaken,
    ConfigRejected,
    ConfigFellBack,
    DeviceFound,
    DeviceLost,
    ForceOff,
    FlightKept,
    QualityChanged,
    ScreenLost,
    ScreenFound,
    GpuReset,
    DiskTrouble,
    Screenshot,
    Note,
};

/// As syslog has them.
enum class Priority : std::uint8_t { Error = 3, Warning = 4, Notice = 5, Info = 6 };

/// One row of the table that the journal's ids and docs/log.md come from. An id never changes its meaning; one that is not used any
/// more is not used again.
struct EventKind {
    Event event;
    std::string_view name;
    std::string_view id;  ///< MESSAGE_ID: 128 bits, drawn by lot
    Priority priority;
    std::string_view meaning;
    std::string_view what_to_do;
};
std::span<const EventKind> event_kinds();
const EventKind& kind_of(Event event);

/// docs/log.md.
std::string log_reference();

}  // namespace eddy
