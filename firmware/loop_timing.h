#pragma once
#include <span>
#include <string>
#include <vector>

#include "hal/clock.h"

namespace eddy {

/// How evenly a loop of 1 kHz ticked. All of the time between ticks.
struct LoopTiming {
    std::size_t ticks = 0;
    Seconds mean{0.0}, deviation{0.0};  ///< standard deviation
    Seconds p999{0.0};                  ///< one period in a thousand is longer
    Seconds longest{0.0};
};
LoopTiming loop_timing(std::span<const Instant> ticks);

/// What a hand does not feel: the mean within 1 % of a millisecond, one period in a thousand above 1.5 ms, none above 5 ms. A
/// device that answers less often than 950 times a second is felt as grain.
inline constexpr Seconds kMeanOff{10e-6}, kMostP999{1.5e-3}, kLongestPeriod{5e-3};
inline constexpr double kLeastExchangesPerS = 950.0;

/// A line for each limit that is missed; none: the loop is good. `exchanges_per_s`: replies of the device, a second.
std::vector<std::string> missed_limits(const LoopTiming& timing, double exchanges_per_s);

}  // namespace eddy
