#include "firmware/haptic_study/metrics.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace eddy::haptic_study {
namespace {

constexpr double kTickS = 1e-3;
constexpr double kLowestHz = 10.0, kHighestHz = 400.0;

std::complex<double> component(Forces forces, int axis, double turns) {
    const std::complex<double> step =
        std::polar(1.0, -2.0 * std::numbers::pi * turns / static_cast<double>(forces.size()));
    std::complex<double> sum = 0.0, phase = 1.0;
    for (const glm::dvec3& force : forces) {
        sum += force[axis] * phase;
        phase *= step;
    }
    return sum / static_cast<double>(forces.size());
}

/// Half of the largest excursion from a parabola through the values: a handle that still slows down does not swing.
template <class Value>
double half_excursion(std::span<const Felt> ticks, Value value) {
    const double n = static_cast<double>(ticks.size());
    // Legendre's polynomials over the ticks; their squares have the means 1, 1/3 and 1/5.
    const auto polynomials = [n](std::size_t i) {
        const double u = (2.0 * static_cast<double>(i) + 1.0) / n - 1.0;
        return glm::dvec3(1.0, u, 0.5 * (3.0 * u * u - 1.0));
    };
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 shares(0.0);
        for (std::size_t i = 0; i < ticks.size(); ++i)
            shares += value(ticks[i])[axis] / n * glm::dvec3(1.0, 3.0, 5.0) * polynomials(i);
        double low = 0.0, high = 0.0;
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            const double off = value(ticks[i])[axis] - glm::dot(shares, polynomials(i));
            low = std::min(low, off);
            high = std::max(high, off);
        }
        most = std::max(most, 0.5 * (high - low));
    }
    return most;
}

}  // namespace

double rms(Forces forces) {
    double sum = 0.0;
    for (const glm::dvec3& force : forces) sum += glm::dot(force, force);
    return forces.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(forces.size()));
}

double trembling(Forces forces) {
    const double seconds = kTickS * static_cast<double>(forces.size());
    // Through a window of Hann, or a force that ends elsewhere than it began would be a jump with parts at all frequencies.
    std::vector<glm::dvec3> seen(forces.begin(), forces.end());
    for (std::size_t i = 0; i < seen.size(); ++i)
        seen[i] *= 1.0 - std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                  static_cast<double>(seen.size()));
    constexpr double kPowerOfWindow = 1.5;
    double sum = 0.0;
    for (double turns = std::ceil(kLowestHz * seconds); turns <= kHighestHz * seconds; ++turns)
        for (int axis = 0; axis < 3; ++axis) sum += 2.0 * std::norm(component(seen, axis, turns));
    return std::sqrt(sum / kPowerOfWindow);
}

double lag_s(Forces forces, Forces reference) {
    const double seconds = kTickS * static_cast<double>(forces.size());
    const auto turning = [seconds](Forces f) {
        return component(f, 0, seconds) + std::complex<double>(0.0, 1.0) * component(f, 1, seconds);
    };
    return std::arg(turning(reference) / turning(forces)) / (2.0 * std::numbers::pi);
}

std::optional<double> half_rise_s(Forces forces) {
    constexpr std::size_t kSettled = 100;
    if (forces.size() <= kSettled) return std::nullopt;
    double settled = 0.0;
    for (const glm::dvec3& force : forces.last(kSettled)) settled += force.x / static_cast<double>(kSettled);
    const double began = forces.front().x;
    for (std::size_t i = 0; i < forces.size(); ++i)
        if ((forces[i].x - began) / (settled - began) >= 0.5) return kTickS * static_cast<double>(i);
    return std::nullopt;
}

double pull_error(const glm::dvec3& felt_n, const glm::dvec3& given_n) {
    return glm::length(felt_n - given_n) / glm::length(given_n);
}

double spent_j(std::span<const Felt> ticks) {
    double spent = 0.0;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        spent -= glm::dot(ticks[i - 1].force_n, ticks[i].position_m - ticks[i - 1].position_m);
    return spent;
}

Swing swing(std::span<const Felt> ticks) {
    if (ticks.size() < 2) return {};
    return {half_excursion(ticks, [](const Felt& tick) { return tick.force_n; }),
            half_excursion(ticks, [](const Felt& tick) { return tick.position_m; })};
}

bool rests(const Swing& found, const Swing& flow) {
    constexpr double kForceN = 0.05, kPositionM = 1e-4, kOfFlow = 2.0;
    return found.force_n <= std::max(kForceN, kOfFlow * flow.force_n) &&
           found.position_m <= std::max(kPositionM, kOfFlow * flow.position_m);
}

}  // namespace eddy::haptic_study
