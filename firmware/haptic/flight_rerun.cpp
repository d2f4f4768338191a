#include "firmware/haptic/flight_rerun.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace eddy {
namespace {

/// To the last bit; but all that is no number is alike.
bool same(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same(const glm::dvec3& a, const glm::dvec3& b) {
    return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

bool same(const LawOutput& a, const LawOutput& b) {
    return same(a.raw_n, b.raw_n) && same(a.filtered_n, b.filtered_n) && same(a.force_n, b.force_n) &&
           a.reason == b.reason && same(a.pose.position_m, b.pose.position_m) &&
           same(a.pose.velocity_m_s, b.pose.velocity_m_s) && a.pose.known == b.pose.known;
}

}  // namespace

Rerun rerun(const Flight& flight) {
    Rerun result;
    HandState state = flight.start;
    for (const FlightTick& tick : flight.ticks) {
        const LawOutput out = hand_tick(state, tick.in, tick.step);
        if (!same(out, tick.out)) {
            if (!result.first) result.first = result.outputs.size();
            ++result.differing;
            const glm::dvec3 apart_n = glm::abs(out.force_n - tick.out.force_n);
            result.most_n = std::max({result.most_n, apart_n.x, apart_n.y, apart_n.z});
        }
        result.outputs.push_back(out);
    }
    return result;
}

}  // namespace eddy
