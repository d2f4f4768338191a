#include "tests/redir/steered_motion.h"

#include <algorithm>

#include "hal/haptic/emulated/minimum_jerk.h"

namespace eddy::redir {
namespace {

constexpr Seconds kReach{0.5};
// Beyond the stops at either end (hal/haptic/emulated/plant.cpp): the hand pushes against them.
constexpr glm::dvec3 kOut{0.0, 0.0, 0.060};
constexpr glm::dvec3 kIn{0.0, 0.0, -0.070};
constexpr Seconds kStayOut{1.0};
constexpr Seconds kHomed{2.5};  // from the start, with half a second in which the hand stays in

}  // namespace

void SteeredMotion::hold(Instant now, const glm::dvec3& place_m) {
    turn_to(Aim::Place, now);
    place_ = place_m;
}

void SteeredMotion::follow(Instant now) {
    turn_to(Aim::Path, now);
}

void SteeredMotion::home(Instant now) {
    turn_to(Aim::Home, now);
}

bool SteeredMotion::homing(Instant now) const {
    return aim_ == Aim::Home && now < since_ + kHomed;
}

void SteeredMotion::turn_to(Aim aim, Instant now) {
    from_ = position_m(now);
    aim_ = aim;
    since_ = now;
}

glm::dvec3 SteeredMotion::position_m(Seconds t) const {
    const double s = std::clamp((t - since_) / kReach, 0.0, 1.0);
    return glm::mix(from_, aim_at(t), emulated::minimum_jerk(s));
}

glm::dvec3 SteeredMotion::aim_at(Seconds t) const {
    switch (aim_) {
        case Aim::Path:
            break;
        case Aim::Place:
            return place_;
        case Aim::Home: {
            const double in = std::clamp((t - since_ - kStayOut) / kReach, 0.0, 1.0);
            const double back = std::clamp((t - since_ - kHomed) / kReach, 0.0, 1.0);
            const glm::dvec3 gesture = glm::mix(kOut, kIn, emulated::minimum_jerk(in));
            return glm::mix(gesture, path_->position_m(t), emulated::minimum_jerk(back));
        }
    }
    return path_->position_m(t);
}

}  // namespace eddy::redir
