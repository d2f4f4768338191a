#include "firmware/haptic/motion_tracker.h"

#include <cmath>
#include <numbers>

#include "firmware/haptic/vector.h"

namespace eddy {
namespace {

constexpr Seconds kLongestGap{0.05};
/// Three equal poles are 3 dB down at 0.51 of their own frequency.
constexpr double kPoles_1_s = 2.0 * std::numbers::pi * MotionTracker::kTrackerHz / 0.5098;

}  // namespace

void MotionTracker::take(const glm::dvec3& position_m, Instant at) {
    if (!is_finite(position_m)) return;
    const Seconds gap = at_ ? Seconds(at - *at_) : kLongestGap;
    if (at_ && gap.count() <= 0.0) return;
    if (!at_ || gap > kLongestGap) {
        forget();
        position_m_ = position_m;
        at_ = at;
        return;
    }
    const double dt = gap.count();
    const double kept = std::exp(-kPoles_1_s * dt), given_up = 1.0 - kept;
    const double g = 1.0 - kept * kept * kept, h = 1.5 * given_up * given_up * (1.0 + kept),
                 k = given_up * given_up * given_up;
    position_m_ += dt * velocity_m_s_ + 0.5 * dt * dt * acceleration_m_s2_;
    velocity_m_s_ += dt * acceleration_m_s2_;
    const glm::dvec3 missed = position_m - position_m_;
    position_m_ += g * missed;
    velocity_m_s_ += h / dt * missed;
    acceleration_m_s2_ += k / (dt * dt) * missed;
    at_ = at;
}

void MotionTracker::forget() {
    at_.reset();
    velocity_m_s_ = acceleration_m_s2_ = glm::dvec3(0.0);
}

}  // namespace eddy
