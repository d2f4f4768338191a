#include "firmware/stability/hand.h"

#include <cmath>

namespace eddy::stability {
namespace {

constexpr double kTickS = kNominalTick.count();
/// The longest stretch of ticks that is played through; longer steps are not for hands.
constexpr double kLongestS = 1.0;

}  // namespace

Hand::Hand(const HapticOrders& orders, const GateLimits& limits)
    : orders_(orders), state_{.gate = ForceGate(limits)} {}

void Hand::tick(double interval_s, const glm::dvec3& target_m, const FluidSnapshot& fluid, bool answered,
                Rule& rule, History& history) {
    if (!held_) at_m_ = target_m;
    held_ = true;
    if (!(interval_s > 0.0)) return;
    owed_s_ += std::min(interval_s, kLongestS);
    const auto ticks = static_cast<long>(std::floor(owed_s_ / kTickS + 1e-6));
    owed_s_ -= kTickS * static_cast<double>(ticks);
    const glm::dvec3 from_m = at_m_;
    for (long i = 1; i <= ticks; ++i) {
        now_ += std::chrono::duration_cast<Instant>(kNominalTick);
        at_m_ = from_m + (target_m - from_m) * (static_cast<double>(i) / static_cast<double>(ticks));
        const LawOutput out =
            law(state_,
                {.now = now_,
                 .reading = HandleReading{orders_.tank_from_device.device_position(at_m_), 0, now_},
                 .device = HapticState::Ready,
                 .fluid = fluid,
                 .orders = orders_},
                kNominalTick);
        pose_ = out.pose;
        rule.feel(out.force_n, kTickS);
        history.ticks.push_back({Seconds(now_).count(), glm::length(out.force_n), answered});
    }
}

}  // namespace eddy::stability
