#include "firmware/haptic/passivity.h"

#include <algorithm>
#include <cmath>

#include "firmware/haptic/sound.h"
#include "firmware/haptic/vector.h"

namespace eddy {

void Passivity::moved_to(const glm::dvec3& position_m, Instant now) {
    if (running_) {
        // The motors held the force all the way: this is its work exactly, with no velocity estimated.
        const glm::dvec3 way = position_m - position_m_;
        now_.hand_j -= glm::dot(force_n_, way);
        now_.damping_j -= glm::dot(damping_n_, way);
    }
    running_ = true;
    position_m_ = position_m;
    now_.at = now;
    past_[next_] = now_;
    next_ = (next_ + 1) % kKept;
}

void Passivity::received(double received_j, double stored_j, Instant pose_time) {
    if (!running_) return;
    // The newest tick that is not after the pose; else the oldest there is.
    Entry then = now_;
    for (std::size_t back = 1; back <= kKept; ++back) {
        const Entry& entry = past_[(next_ + kKept - back) % kKept];
        if (entry.at > then.at)
            break;  // from before the last beginning; what was never written is of the very beginning
        then = entry;
        if (entry.at <= pose_time) break;
    }
    if (answered_ && std::isfinite(received_j)) {
        balance_j_ += then.hand_j - settled_.hand_j - received_j + kTolerated * std::abs(received_j);
        balance_j_ = std::min(balance_j_, kReserveJ);
    }
    stored_j_ = std::isfinite(stored_j) ? std::max(0.0, stored_j) : 0.0;
    settled_ = then;
    answered_ = true;
    least_j_ = std::min(least_j_, energy_j());
}

glm::dvec3 Passivity::damping_n(const glm::dvec3& velocity_m_s, double drag_ns_m) const {
    const double debt_j = -energy_j() - stored_j_;
    const double speed2 = glm::dot(velocity_m_s, velocity_m_s);
    if (!(debt_j > 0.0) || !(speed2 > 0.0) || !answered_) return glm::dvec3(0.0);
    const double moves = speed2 / (speed2 + kStillMS * kStillMS);
    const double most_ns_m = std::max(0.0, kMostTrackedNsM - drag_ns_m);
    return -moves * std::min(most_ns_m, debt_j / (speed2 * kPayBack.count())) * velocity_m_s;
}

void Passivity::given(const glm::dvec3& force_n, const glm::dvec3& damping_n) {
    const bool sound = is_finite(force_n) && is_finite(damping_n);
    force_n_ = sound ? force_n : glm::dvec3(0.0);
    damping_n_ = sound ? damping_n : glm::dvec3(0.0);
    if (damping_n_ != glm::dvec3(0.0)) ++damped_;
}

bool Passivity::is_sound() const {
    return next_ < kKept && eddy::is_sound(running_) && eddy::is_sound(answered_);
}

void Passivity::begin_anew() {
    if (!running_) return;
    const double least_j = least_j_;
    const std::uint64_t damped = damped_;
    *this = Passivity{};
    least_j_ = least_j;
    damped_ = damped;
}

}  // namespace eddy
