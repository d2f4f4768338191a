#include "firmware/stability/rule.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "firmware/haptic/vector.h"
#include "gles/fluid/step_guard.h"

namespace eddy::stability {
namespace {

/// Less than the whole range allowed by more than rounding.
bool leaves(const FieldRange& found, const FieldRange& start, const FieldRange& added) {
    const double low = std::min(0.0, start.low) + added.low, high = std::max(0.0, start.high) + added.high;
    const double margin = kRangeMargin * (high - low) + 1e-6;
    return found.low < low - margin || found.high > high + margin;
}

}  // namespace

Rule::Rule(const Tank& tank, const HandLimits& hand) : tank_(tank), hand_(hand) {}

void Rule::begin(const Fields& fields) {
    verdict_.non_finite = non_finite_texels(fields);
    if (verdict_.non_finite > 0)
        return blame(0, fmt::format("{} texels not finite before the first step", verdict_.non_finite));
    start_energy_j_ = least_j_ = kinetic_energy_j(tank_, fields);
    start_speed_m_s_ = largest_speed_m_s(tank_, fields);
    start_smoke_ = range_of(fields.smoke);
    start_temperature_k_ = range_of(fields.temperature_k);
}

void Rule::blame(long step, const std::string& reason) {
    fail(fmt::format("step {}: {}", step, reason));
}

void Rule::fail(std::string reason) {
    if (!verdict_.pass) return;
    verdict_.pass = false;
    verdict_.reason = std::move(reason);
}

void Rule::see(const StepSeen& step) {
    time_s_ = step.time_s;
    see_loads(step);
    if (step.fields) judge(step);
    see_calm(step);
}

void Rule::see_loads(const StepSeen& step) {
    force_n_ = 0.0;
    for (std::size_t i = 0; i < step.loads.size(); ++i) {
        const gles::Load& load = step.loads[i];
        if (!gles::is_finite(load)) {
            ++verdict_.non_finite;
            if (!step.pardoned) blame(step.step, fmt::format("the load on body {} is not finite", i));
            continue;
        }
        force_n_ = std::max(force_n_, glm::length(load.force_n));
    }
    verdict_.largest_force_n = std::max(verdict_.largest_force_n, force_n_);
}

void Rule::judge(const StepSeen& step) {
    const Fields& fields = *step.fields;
    const long bad = non_finite_texels(fields);
    verdict_.non_finite = std::max(verdict_.non_finite, bad);
    if (step.pardoned) {
        // A fault may leave energy behind, and has no books.
        lately_.clear();
        least_j_ = start_energy_j_;
        return;
    }
    if (bad > 0) return blame(step.step, fmt::format("{} texels are not finite", bad));

    const Justified& may = step.justified;
    const double fastest = std::max(may.speed_m_s, start_speed_m_s_);
    const double allowed = kSpeedFactor * may.narrowing * fastest + kRestShare * may.rest_speed_m_s;
    const double speed = largest_speed_m_s(tank_, fields);
    if (!(speed <= allowed + std::numeric_limits<double>::min()))
        blame(step.step, fmt::format("the fluid moves at {:.3g} m/s, {:.3g} times as fast as anything that "
                                     "moves it; {:.3g} m/s would do",
                                     speed, fastest > 0.0 ? speed / fastest : INFINITY, allowed));

    energy_j_ = kinetic_energy_j(tank_, fields);
    const double rest = kRestShare * std::max(may.rest_speed_m_s, fastest);
    for (; !lately_.empty() && lately_.front().time_s < step.time_s - kEnergyMemoryS; lately_.pop_front())
        least_j_ = std::min(least_j_, lately_.front().energy_j);
    lately_.push_back({step.time_s, energy_j_ - (may.work_j - may.ahead_j)});
    const double most_j = std::max(0.0, least_j_ + may.work_j) +
                          kEnergyMargin * (start_energy_j_ + may.given_j) +
                          0.5 * tank_.mass_kg() * rest * rest;
    const double ratio = energy_j_ > 0.0 ? energy_j_ / most_j : 0.0;
    verdict_.kinetic_energy_ratio = std::max(verdict_.kinetic_energy_ratio, ratio);
    if (!(ratio <= 1.0))
        blame(step.step, fmt::format("kinetic energy {:.3g} J, {:.3g} times what it had and was given",
                                     energy_j_, ratio));

    const FieldRange smoke = range_of(fields.smoke), heat = range_of(fields.temperature_k);
    if (leaves(smoke, start_smoke_, may.smoke_added))
        blame(step.step,
              fmt::format("smoke from {:.4g} to {:.4g}, which no source explains", smoke.low, smoke.high));
    if (leaves(heat, start_temperature_k_, may.temperature_added_k))
        blame(step.step, fmt::format("temperature from {:.4g} to {:.4g} K, which no source explains",
                                     heat.low, heat.high));
}

void Rule::see_calm(const StepSeen& step) {
    if (step.disturbed || step.pardoned) {
        peak_force_n_ = std::max(peak_force_n_, force_n_);
        calm_ = false;
        calm_since_s_ = step.time_s;
        force_calm_s_.reset();
        energy_calm_s_.reset();
        return;
    }
    if (!calm_) {
        calm_ = true;
        calm_energy_j_ = energy_j_;
    }
    if (force_n_ > kCalmForce * peak_force_n_)
        force_calm_s_.reset();
    else if (!force_calm_s_)
        force_calm_s_ = step.time_s - calm_since_s_;
    if (energy_j_ > 0.5 * calm_energy_j_)
        energy_calm_s_.reset();
    else if (!energy_calm_s_)
        energy_calm_s_ = step.time_s - calm_since_s_;
}

void Rule::feel(const glm::dvec3& force_n, double dt_s) {
    const double rounding = 1e-9;
    felt_s_ += dt_s;
    const auto complain = [&](const std::string& reason) {
        fail(fmt::format("{:.3f} s of the hand: {}", felt_s_, reason));
    };
    const double now = glm::length(force_n), before = glm::length(felt_n_);
    if (!is_finite(force_n)) return complain("it gets a force that is not finite");
    if (now > hand_.most_n + rounding)
        complain(fmt::format("it gets {:.3g} N, more than its {:.3g} N", now, hand_.most_n));
    const double step = glm::length(force_n - felt_n_);
    const bool falls = step <= before - now + rounding;  // straight towards zero
    if (!falls && step > hand_.slew_n_per_s * dt_s + rounding)
        complain(fmt::format("its force changes by {:.3g} N in {:.3g} ms", step, 1e3 * dt_s));
    felt_n_ = force_n;
}

Verdict Rule::verdict() const {
    Verdict verdict = verdict_;
    const double viscosity_m2_s = tank_.viscosity_pa_s / tank_.density_kg_m3;
    const double length_m = tank_.longest_m();
    const double friction_s =
        viscosity_m2_s > 0.0 ? length_m * length_m / (std::numbers::pi * std::numbers::pi * viscosity_m2_s)
                             : std::numeric_limits<double>::infinity();
    const double calm_s = calm_ ? time_s_ - calm_since_s_ : 0.0;
    if (force_calm_s_ && energy_calm_s_) verdict.recovery_s = std::max(*force_calm_s_, *energy_calm_s_);
    const double rounding_s = 1e-6;
    const auto complain = [&](const std::string& reason) {
        if (!verdict.pass) return;
        verdict.pass = false;
        verdict.reason = reason;
    };
    if (calm_s + rounding_s >= kCalmS && !force_calm_s_)
        complain(fmt::format("{:.3g} s after the last disturbance the force is {:.3g} % of its peak", calm_s,
                             100.0 * force_n_ / peak_force_n_));
    if (calm_s + rounding_s >= std::max(kCalmS, friction_s) && !energy_calm_s_)
        complain(fmt::format("{:.3g} s after the last disturbance {:.3g} % of the kinetic energy are left",
                             calm_s, 100.0 * energy_j_ / calm_energy_j_));
    return verdict;
}

}  // namespace eddy::stability
