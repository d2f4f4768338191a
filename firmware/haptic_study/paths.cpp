#include "firmware/haptic_study/paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/haptic/emulated/minimum_jerk.h"

namespace eddy::haptic_study {
namespace {

constexpr double kRampS = 0.5;

glm::dvec3 on_circle(double t, double hz) {
    const double angle = 2.0 * std::numbers::pi * hz * t;
    const double ramp = emulated::minimum_jerk(std::clamp(t / kRampS, 0.0, 1.0));
    return ramp * kCircleM * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
}

}  // namespace

Path circle(double hz) {
    return [hz](Seconds t) { return on_circle(t.count(), hz); };
}

Path stir_then_go(Seconds until, Seconds start, double speed_m_s) {
    return [=](Seconds t) {
        const double left = 1.0 - emulated::minimum_jerk(std::clamp((t - until).count() / kRampS, 0.0, 1.0));
        return left * on_circle(t.count(), 1.0) +
               glm::dvec3(speed_m_s * std::max(0.0, (t - start).count()), 0.0, 0.0);
    };
}

Path stir_then_leap(Seconds until) {
    return [until](Seconds t) { return t < until ? on_circle(t.count(), 1.0) : glm::dvec3(0.0); };
}

}  // namespace eddy::haptic_study
