#include "firmware/haptic/force_gate.h"

#include <algorithm>
#include <cmath>

#include "firmware/haptic/vector.h"

namespace eddy {

// A limit that is negative or not a number shuts the gate rather than opening it.
ForceGate::ForceGate(const GateLimits& limits)
    : limits_{.max_force_n = std::min(std::max(0.0, limits.max_force_n), kDeviceMaxForceN),
              .slew_n_per_s = std::max(0.0, limits.slew_n_per_s)} {}

glm::dvec3 ForceGate::operator()(const GateInput& in, Seconds dt) {
    if (!(dt.count() > 0.0)) dt = Seconds{0.0};
    const bool goes_on = reason_ == GateReason::FluidStale || reason_ == GateReason::DeviceUnsure;
    reason_ = judge(in);
    switch (reason_) {
        case GateReason::Open:
        case GateReason::Starting:
            return sent_n_ = follow(in, std::min(dt, kLongestRise));
        case GateReason::FluidStale:
            hiccup(!goes_on, dt);
            return sent_n_ = fade(dt);
        case GateReason::DeviceUnsure:
            hiccup(!goes_on, dt);
            strength_ = 0.0;
            return sent_n_ = glm::dvec3(0.0);
        case GateReason::TooFast:
        case GateReason::Released:
        case GateReason::Disabled:
        case GateReason::Stopped:
        case GateReason::DeviceNotReady:
        case GateReason::DeviceSilent:
        case GateReason::NotFinite:
            break;
    }
    strength_ = 0.0;
    had_ = 0.0;
    return sent_n_ = glm::dvec3(0.0);
}

bool ForceGate::is_sound() const {
    const auto known = [](GateReason reason) {
        return static_cast<std::size_t>(reason) < kGateSentences.size();
    };
    return known(latch_) && known(reason_);
}

GateReason ForceGate::judge(const GateInput& in) {
    if (in.reset) latch_ = GateReason::Open;
    if (in.device_silent) latch_ = std::max(latch_, GateReason::DeviceSilent);
    if (!is_finite(in.force_n) || !std::isfinite(in.speed_m_s)) {
        ++counters_.non_finite;
        latch_ = GateReason::NotFinite;
    }
    if (latch_ != GateReason::Open) return latch_;
    if (!in.device_ready) return GateReason::DeviceNotReady;
    if (!in.enabled) return GateReason::Disabled;
    if (in.speed_m_s > kFastestHandMS) return GateReason::TooFast;
    if (in.device_unsure) return GateReason::DeviceUnsure;
    if (in.fluid_stale) return GateReason::FluidStale;
    return strength_ < 1.0 ? GateReason::Starting : GateReason::Open;
}

/// What takes the force for no longer than kHiccup leaves behind how much of it there was.
void ForceGate::hiccup(bool begins, Seconds dt) {
    if (begins) {
        hiccup_for_ = Seconds(0.0);
        had_ = std::max(had_, strength_);
    }
    hiccup_for_ += dt;
    if (hiccup_for_ > kHiccup) had_ = 0.0;
}

// Straight to zero from where it is. The slew limit has no say: a slow one must not keep a force nobody
// computes.
glm::dvec3 ForceGate::fade(Seconds dt) {
    const double rounding = 1e-9;  // 400 subtractions of 1/400 miss zero by 1e-14
    const double before = strength_;
    strength_ -= dt / kFade;
    if (strength_ < rounding) strength_ = 0.0;
    return before > 0.0 ? sent_n_ * (strength_ / before) : glm::dvec3(0.0);
}

glm::dvec3 ForceGate::follow(const GateInput& in, Seconds dt) {
    const double most_n = std::min(limits_.max_force_n, std::max(0.0, in.most_n));
    const glm::dvec3 clamped = shorten(in.force_n, most_n);
    if (clamped != in.force_n) ++counters_.clamped;

    strength_ = std::min(1.0, strength_ + dt / (strength_ < had_ ? kQuickReturn : kSoftStart));
    const glm::dvec3 step = strength_ * clamped - sent_n_;
    const glm::dvec3 allowed = shorten(step, limits_.slew_n_per_s * dt.count());
    if (allowed != step) ++counters_.slewed;
    return sent_n_ + allowed;
}

}  // namespace eddy
