#include "hal/haptic/emulated/person_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hal/haptic/emulated/minimum_jerk.h"

namespace eddy::emulated {
namespace {

constexpr double kPeriod = 120.0;  // [s]; the last segment begins before this

// Everyday speeds, chosen to look like recorded hands (BROAD trials 03 and 16: 0.25 to 0.32 m/s at most, one
// turn a second).
constexpr double kSlowest = 0.06, kFastest = 0.20;             // [m/s], mean of a reach
constexpr double kShortestReach = 0.5;                         // [s]
constexpr double kShortestPause = 0.3, kLongestPause = 1.5;    // [s]
constexpr double kSmallestStir = 0.008, kLargestStir = 0.022;  // [m], radius
constexpr double kSlowestStir = 0.5, kFastestStir = 1.0;       // [1/s], mean turns
constexpr double kFewestTurns = 2.0, kMostTurns = 5.0;

/// Numbers that are the same everywhere: mt19937_64 is fixed by the standard, its distributions are not.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
    }
    glm::dvec3 inside(const glm::dvec3& half_size) {
        const double x = between(-half_size.x, half_size.x);
        const double y = between(-half_size.y, half_size.y);
        const double z = between(-half_size.z, half_size.z);
        return {x, y, z};
    }

  private:
    std::mt19937_64 engine_;
};

/// How far a circle reaches from its centre along each axis, when these two radii span it.
glm::dvec3 extent(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::sqrt(a * a + b * b);
}

bool holds(const glm::dvec3& half_size, const glm::dvec3& offset, const glm::dvec3& reach) {
    const glm::dvec3 farthest = glm::abs(offset) + reach;
    return farthest.x <= half_size.x && farthest.y <= half_size.y && farthest.z <= half_size.z;
}

}  // namespace

PersonMotion::PersonMotion(const PersonSettings& settings) {
    Dice dice(settings.seed);
    const glm::dvec3 start = settings.centre_m;
    glm::dvec3 hand = start;
    double t = 0.0;
    const auto reach = [&](const glm::dvec3& to) {
        const double duration =
            std::max(kShortestReach, glm::length(to - hand) / dice.between(kSlowest, kFastest));
        segments_.push_back({t, duration, hand, to, hand, glm::dvec3(0.0), 0.0});
        t += duration;
        hand = to;
    };
    const auto pause = [&] {
        const double duration = dice.between(kShortestPause, kLongestPause);
        segments_.push_back({t, duration, hand, hand, hand, glm::dvec3(0.0), 0.0});
        t += duration;
    };
    const auto stir = [&] {
        // A circle through the hand, about a point in a random direction, made smaller until the box holds
        // it.
        const glm::dvec3 towards = glm::normalize(
            settings.centre_m + dice.inside(settings.half_size_m) * 0.5 - hand + glm::dvec3(1e-9));
        const glm::dvec3 side =
            glm::normalize(glm::cross(towards, dice.inside(glm::dvec3(1.0))) + glm::dvec3(1e-9));
        const double turns = std::floor(dice.between(kFewestTurns, kMostTurns + 1.0));
        const double duration = turns / dice.between(kSlowestStir, kFastestStir);
        double radius = dice.between(kSmallestStir, kLargestStir);
        const auto fits = [&] {
            return holds(settings.half_size_m, hand + radius * towards - settings.centre_m,
                         extent(radius * towards, radius * side));
        };
        while (radius > kSmallestStir && !fits()) radius *= 0.8;
        if (!fits()) return;
        segments_.push_back({t, duration, hand, hand, hand + radius * towards, radius * side, turns});
        t += duration;
    };
    while (t < kPeriod) {
        const double choice = dice.between(0.0, 1.0);
        if (choice < 0.5)
            reach(settings.centre_m + dice.inside(settings.half_size_m));
        else if (choice < 0.85)
            stir();
        else
            pause();
    }
    reach(start);
    period_ = t;
}

glm::dvec3 PersonMotion::position_m(Seconds t) const {
    double in_period = std::fmod(t.count(), period_);
    if (in_period < 0.0) in_period += period_;
    const auto next =
        std::upper_bound(segments_.begin(), segments_.end(), in_period,
                         [](double time, const Segment& segment) { return time < segment.start; });
    const Segment& now = *(next - 1);
    const double s = minimum_jerk(std::clamp((in_period - now.start) / now.duration, 0.0, 1.0));
    if (now.turns == 0.0) return glm::mix(now.from, now.to, s);
    const double angle = 2.0 * std::numbers::pi * now.turns * s;
    return now.centre + std::cos(angle) * (now.from - now.centre) + std::sin(angle) * now.across;
}

}  // namespace eddy::emulated
