#include "firmware/haptic/energy_match.h"

#include <algorithm>
#include <cmath>

#include "firmware/haptic/exponential.h"
#include "firmware/haptic/sound.h"

namespace eddy {
namespace {

constexpr Seconds kChord{0.010};
/// Slower than this on the mean, a hand rests and its model is as it is.
constexpr double kStillMS = 0.01;
constexpr double kStill = kStillMS * kStillMS * EnergyMatch::kMemory.count();
/// The shares follow the books so fast.
constexpr Seconds kFollow{0.2};

}  // namespace

void EnergyMatch::moved_to(const glm::dvec3& position_m, const glm::dvec3& velocity_m_s,
                           const glm::dvec3& acceleration_m_s2, Seconds dt) {
    if (!position_m_) {
        position_m_ = chord_from_m_ = position_m;
        chord_ = Seconds(0.0);
        return;
    }
    const glm::dvec3 way_m = position_m - *position_m_;
    position_m_ = position_m;
    const double kept = left_of(std::max(0.0, dt.count()) / kMemory.count());
    tracked_drag_ = kept * tracked_drag_ + glm::dot(velocity_m_s, way_m);
    tracked_added_ = kept * tracked_added_ + glm::dot(acceleration_m_s2, way_m);
    true_drag_ *= kept;
    began_ *= kept;
    chord_ += dt;
    if (chord_ < kChord) return;
    const glm::dvec3 chord_m = position_m - chord_from_m_;
    const double speed2 = glm::dot(chord_m, chord_m) / (chord_.count() * chord_.count());
    if (true_drag_ == 0.0) began_ = 0.5 * speed2;
    true_drag_ += speed2 * chord_.count();
    // With a memory T that fades, the integral of w dw is w^2 / 2 less the integral of w^2 / 2 T, and less what there was.
    true_added_ = 0.5 * speed2 - 0.5 * true_drag_ / kMemory.count() - began_;
    chord_from_m_ = position_m;
    chord_ = Seconds(0.0);
}

EnergyMatch::Shares EnergyMatch::follow(double drag_ns_m, double added_kg, Seconds dt) {
    const double may_cost = kAllowed * drag_ns_m * (true_drag_ + kStill);
    const double of_drag = drag_ns_m * (tracked_drag_ + kStill);
    const double of_mass = added_kg * (tracked_added_ - true_added_);
    Shares wanted;
    if (of_drag > 0.0) wanted.drag = std::clamp((may_cost - of_mass) / of_drag, 0.0, 1.0);
    if (of_mass > may_cost) wanted.added = may_cost / of_mass;
    const double share = dt.count() > 0.0 ? gone_of(dt / kFollow) : 0.0;
    shares_.drag += share * (wanted.drag - shares_.drag);
    shares_.added += share * (wanted.added - shares_.added);
    return shares_;
}

bool EnergyMatch::is_sound() const {
    return eddy::is_sound(position_m_);
}

void EnergyMatch::forget() {
    const Shares shares = shares_;
    *this = EnergyMatch{};
    shares_ = shares;
}

}  // namespace eddy
