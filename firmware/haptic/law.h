#pragma once
#include <optional>

#include "firmware/haptic/exchange.h"
#include "firmware/haptic/force_gate.h"
#include "firmware/haptic/hand_force.h"
#include "firmware/haptic/hand_motion.h"

namespace eddy {

/// A device that has answered before and is silent this long is lost: zero at once, latched (libfranka gives
/// up after 20 missed replies at 1 kHz).
inline constexpr Seconds kReplyTimeout{0.020};
/// A fluid snapshot older than this, and older than four fluid periods, is stale: the force fades out (kFade). An answer that
/// comes three periods late is in time; when none comes, at 50 steps a second the force is 0 within 100 ms of when it was
/// due, at 75 within 100 ms of the last.
inline constexpr Seconds kFluidTimeout{0.050};
inline constexpr double kFluidPeriodsAllowed = 4.0;

/// Time between ticks when none is late.
inline constexpr Seconds kNominalTick{0.001};

struct HapticInput {
    Instant now{0};
    std::optional<HandleReading> reading = std::nullopt;  ///< newest not yet handed out, if one arrived
    HapticState device = HapticState::Absent;
    bool obeys = true;     ///< the device would do now what it is told
    Seconds silence{0.0};  ///< since the device's last good reply
    FluidSnapshot fluid{};
    HapticOrders orders{};
};

/// What the law remembers from tick to tick.
struct LawState {
    HandMotion hand{};
    HandForce force{};
    ForceGate gate{};
    bool answered = false;  ///< the device has given a reading since start or the last reset
    std::uint8_t buttons = 0;
    std::uint64_t fluid_sequence = 0;  ///< of the snapshot held, and
    Instant fluid_arrived{0};          ///< the tick that saw it first
    std::uint64_t resets = 0;
    std::uint64_t ticks = 0;
};

struct LawOutput {
    PoseSnapshot pose{};
    glm::dvec3 raw_n{0.0};       ///< gain * fluid force, held between fluid updates
    glm::dvec3 filtered_n{0.0};  ///< as wanted of the gate: smoothed, and with the walls of the tank
    glm::dvec3 force_n{0.0};     ///< through the gate: what the hand gets, Device frame
    GateReason reason = GateReason::Disabled;
    Instant fluid_age{0};  ///< since the held snapshot arrived
};

/// One tick of the hand. Pure: same state and input, same output, bit for bit; knows no clock, device or
/// thread.
LawOutput law(LawState& state, const HapticInput& in, Seconds dt);

}  // namespace eddy
