#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "firmware/haptic/dead_man.h"
#include "firmware/haptic/force_gate.h"
#include "firmware/haptic/force_law.h"
#include "firmware/haptic/snapshot.h"
#include "hal/frames.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

/// From the fluid: the force on the body for one pose of the hand.
struct FluidSnapshot {
    glm::dvec3 force_n{0.0};    ///< ON the body BY the fluid, before gain; same axes in Tank and Device frame
    glm::dvec3 torque_nm{0.0};  ///< about the body's centre; for devices that turn, and for the record
    std::uint64_t sequence = 0;         ///< counts up from 1; 0: nothing computed yet
    Instant computed_for{0};            ///< PoseSnapshot::time of the pose it answers
    Seconds fluid_period{0.0};          ///< measured time between fluid updates
    glm::dvec3 velocity_m_s{0.0};       ///< of the body in the step that gave the force, Tank frame
    glm::dvec3 acceleration_m_s2{0.0};  ///< from the step before to that one
    /// Received by the fluid from the body, in all steps since the start; below 0: given to it.
    double received_j = 0.0;
    double stored_j = 0.0;  ///< kinetic energy of the fluid when it was last looked at
};

/// To the fluid: where the virtual body is. Always inside the bounds it was given.
struct PoseSnapshot {
    glm::dvec3 position_m{0.0};    ///< Tank frame
    glm::dvec3 velocity_m_s{0.0};  ///< Tank frame; zero across a bound the body rests against
    std::uint64_t sequence = 0;    ///< counts ticks from 1; 0: the loop has not run
    Instant time{0};               ///< tick that made it
    std::uint8_t buttons = 0;      ///< as in HandleReading
    bool known = false;            ///< the device is ready and answering; if not, the position means nothing
};

/// To the loop: what the exhibit wants of it.
struct HapticOrders {
    bool enabled = false;  ///< force allowed; drop it on pause, scene change and fluid reset
    double gain = 1.0;     ///< newtons on the hand per newton on the body
    double most_n =
        kDeviceMaxForceN;  ///< on the hand; a lower one than before is reached within the slew limit
    TankFromDevice tank_from_device{};  ///< where the hand's workspace lies in the tank
    glm::dvec3 lowest_m{0.0};           ///< corners of the box the body's centre may not leave, Tank frame
    glm::dvec3 highest_m{0.0};
    std::uint64_t resets = 0;    ///< count it up to clear a latched fault
    bool stop = false;           ///< the stop input is pressed: no force, and none after it until
    std::uint64_t restarts = 0;  ///< this is counted up while it is not
};

/// From the loop: counters for the status page. Totals since start.
struct LoopReport {
    std::uint64_t ticks = 0;
    std::uint64_t late = 0;    ///< ticks that began more than kLate after they were due
    std::uint64_t missed = 0;  ///< ticks left out because their time had passed
    Instant worst_late{0};
    Seconds fluid_lateness{
        0.0};  ///< from a pose to the tick that has the fluid's answer to it, over some eight answers
    std::uint64_t impulses = 0;  ///< ticks whose raw force was limited before the filter
    ForceReport force{};
    GateCounters gate{};
    DeadManCounters hand{};
    GateReason reason = GateReason::Disabled;
    HapticState device = HapticState::Absent;
    HapticCounters device_counters{};
};

/// Everything that passes between the loop and the rest of the program. Each has one writer and one reader.
struct HapticExchange {
    Snapshot<FluidSnapshot> fluid;               ///< fluid -> loop
    Snapshot<HapticOrders> orders;               ///< exhibit -> loop
    Snapshot<PoseSnapshot> pose;                 ///< loop -> fluid
    Snapshot<LoopReport> report;                 ///< loop -> exhibit
    Snapshot<std::optional<HandleLight>> light;  ///< exhibit -> loop; nothing: the device's own
};

}  // namespace eddy
