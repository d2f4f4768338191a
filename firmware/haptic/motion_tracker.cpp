#include "firmware/haptic/motion_tracker.h"

#include <algorithm>
#include <cmath>

#include "firmware/haptic/exponential.h"
#include "firmware/haptic/sound.h"
#include "firmware/haptic/vector.h"

namespace eddy {
namespace {

constexpr Seconds kLongestGap{0.05};

/// The poles for a hand that is so far from where it was expected.
double poles_1_s(double missed_m) {
    using T = MotionTracker;
    const double open = std::clamp((missed_m - T::kExpectedM) / (T::kMissedM - T::kExpectedM), 0.0, 1.0);
    return std::lerp(T::kCalm_1_s, T::kQuick_1_s, open);
}

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
    position_m_ += dt * velocity_m_s_ + 0.5 * dt * dt * acceleration_m_s2_;
    velocity_m_s_ += dt * acceleration_m_s2_;
    const glm::dvec3 missed = position_m - position_m_;
    const double kept = left_of(poles_1_s(glm::length(missed)) * dt), given_up = 1.0 - kept;
    const double g = 1.0 - kept * kept * kept, h = 1.5 * given_up * given_up * (1.0 + kept),
                 k = given_up * given_up * given_up;
    position_m_ += g * missed;
    velocity_m_s_ += h / dt * missed;
    acceleration_m_s2_ += k / (dt * dt) * missed;
    at_ = at;
}

glm::dvec3 MotionTracker::near(const glm::dvec3& position_m) const {
    if (!at_) return position_m;
    const glm::dvec3 away = position_m_ - position_m;
    const double far_m = glm::length(away);
    return position_m + (far_m > kExpectedM ? kExpectedM / far_m : 1.0) * away;
}

bool MotionTracker::is_sound() const {
    return eddy::is_sound(at_) && (!at_ || eddy::is_sound(*at_));
}

void MotionTracker::forget() {
    at_.reset();
    velocity_m_s_ = acceleration_m_s2_ = glm::dvec3(0.0);
}

}  // namespace eddy
