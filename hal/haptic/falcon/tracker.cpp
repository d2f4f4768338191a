#include "hal/haptic/falcon/tracker.h"

#include <algorithm>
#include <cmath>

namespace eddy::falcon {
namespace {

constexpr double kMaxCountsPerMs = 300.0;  // over 10 m/s at the handle: no hand does that
constexpr Instant kPoseLifetime = std::chrono::milliseconds(20);

}  // namespace

Tracker::Outcome Tracker::take(const Axes& encoders, Instant at) {
    if (!plausible(encoders, at)) return Outcome::Implausible;
    encoders_ = encoders;
    encoders_at_ = at;
    const auto position = kinematics_.solve(arm_angles(encoders));
    if (!position) return Outcome::Unsolved;
    position_m_ = device_from_base(*position);
    legs_ = inverse_kinematics(*position);
    legs_at_ = at;
    return Outcome::Followed;
}

void Tracker::forget() {
    encoders_.reset();
    legs_.reset();
}

std::optional<Legs> Tracker::legs(Instant now) const {
    return now - legs_at_ <= kPoseLifetime ? legs_ : std::nullopt;
}

bool Tracker::plausible(const Axes& encoders, Instant at) const {
    if (!encoders_) return true;
    // What a hand can do grows with time, so that a jump that stays is believed in the end.
    const double elapsed_ms = Seconds(at - encoders_at_).count() * 1e3;
    const double allowed = kMaxCountsPerMs * std::max(1.0, elapsed_ms);
    for (std::size_t i = 0; i < encoders.size(); ++i)
        if (std::abs(encoders[i] - (*encoders_)[i]) > allowed) return false;
    return true;
}

}  // namespace eddy::falcon
