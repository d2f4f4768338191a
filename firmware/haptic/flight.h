#pragma once
#include <string>
#include <type_traits>
#include <vector>

#include "firmware/haptic/hand_tick.h"

namespace eddy {

/// A tick of the loop: what it was given, and what came of it.
struct FlightTick {
    Instant step{0};  ///< since the tick before
    HapticInput in{};
    LawOutput out{};
};

/// The last seconds before a fault, with all that is needed to run them again.
struct Flight {
    std::string version;  ///< of the program that wrote it
    std::string written;  ///< by the machine's clock, UTC
    GateReason cause = GateReason::Open;
    Instant at{0};  ///< when it happened
    HapticLoopSettings settings{};
    HandState start{};  ///< before the first tick
    std::vector<FlightTick> ticks;
};
static_assert(std::is_trivially_copyable_v<HandState>, "it is kept as its bytes");

}  // namespace eddy
