#include "firmware/loop_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy {

LoopTiming loop_timing(std::span<const Instant> ticks) {
    LoopTiming timing{.ticks = ticks.size()};
    if (ticks.size() < 2) return timing;
    std::vector<double> periods;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        periods.push_back(Seconds(ticks[i] - ticks[i - 1]).count());
    const auto count = static_cast<double>(periods.size());
    double sum = 0.0, squares = 0.0;
    for (const double period : periods) sum += period;
    const double mean = sum / count;
    for (const double period : periods) squares += (period - mean) * (period - mean);
    std::sort(periods.begin(), periods.end());
    // The shortest of the longest thousandth.
    const auto above = static_cast<std::size_t>(count / 1000.0);
    timing.mean = Seconds(mean);
    timing.deviation = Seconds(std::sqrt(squares / count));
    timing.p999 = Seconds(periods[periods.size() - 1 - std::min(above, periods.size() - 1)]);
    timing.longest = Seconds(periods.back());
    return timing;
}

std::vector<std::string> missed_limits(const LoopTiming& timing, double exchanges_per_s) {
    std::vector<std::string> missed;
    const double to_ms = 1e3;
    const Seconds off(std::abs(timing.mean.count() - 1e-3));
    if (timing.ticks < 2 || off > kMeanOff)
        missed.push_back(fmt::format("the mean period is {:.3f} ms; it should be 1 ms within {:.2f}",
                                     timing.mean.count() * to_ms, kMeanOff.count() * to_ms));
    if (timing.p999 > kMostP999)
        missed.push_back(
            fmt::format("one period in a thousand is longer than {:.2f} ms; it should be at most {:.1f}",
                        timing.p999.count() * to_ms, kMostP999.count() * to_ms));
    if (timing.longest > kLongestPeriod)
        missed.push_back(fmt::format("the longest period is {:.2f} ms; none should be above {:.0f}",
                                     timing.longest.count() * to_ms, kLongestPeriod.count() * to_ms));
    if (!(exchanges_per_s >= kLeastExchangesPerS))
        missed.push_back(
            fmt::format("the device answers {:.0f} times a second; it should at least {:.0f} times",
                        exchanges_per_s, kLeastExchangesPerS));
    return missed;
}

}  // namespace eddy
