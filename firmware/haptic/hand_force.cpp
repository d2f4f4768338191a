#include "firmware/haptic/hand_force.h"

#include <cmath>

#include "firmware/haptic/low_pass.h"
#include "firmware/haptic/stability_limits.h"
#include "firmware/haptic/vector.h"

namespace eddy {
namespace {

/// Of the bandwidth for what the model does not explain, given up where it explains all.
constexpr double kLaterShare = 0.6;

}  // namespace

glm::dvec3 HandForce::operator()(const FluidSnapshot& fluid, bool fresh, const HapticOrders& orders,
                                 const HandAtTick& hand, Seconds dt) {
    const double gain = orders.gain, scale = orders.tank_from_device.scale;
    follow(hand, scale, dt);
    if (law_ == ForceLaw::Filter) return filter_(gain * fluid.force_n, fluid.fluid_period, dt);

    // Slopes are those of the tank; the handle moves 1 / scale as far, and feels gain times as much.
    const double at_handle = gain * scale;
    const SlopeBounds bounds = at_handle > 0.0 ? SlopeBounds{most_drag_ns_m(fluid.fluid_period) / at_handle,
                                                             kMostAddedKg / at_handle}
                                               : SlopeBounds{};
    if (fresh) hear(fluid, bounds, gain / scale);
    model_.follow(dt, bounds);
    const glm::dvec3 unexplained_n =
        fluid.force_n - model_.force_n(fluid.velocity_m_s, fluid.acceleration_m_s2);
    const EnergyMatch::Shares shares = match_.follow(model_.drag_ns_m(), model_.added_kg(), dt);
    const glm::dvec3 explained_n = model_.force_n(scale * shares.drag * hand_.velocity_m_s(),
                                                  scale * shares.added * hand_.acceleration_m_s2());
    const glm::dvec3 damping_n =
        passivity_.damping_n(hand_.velocity_m_s(), at_handle * shares.drag * model_.drag_ns_m());
    // The more the model explains, the less of the rest is the hand's: it may come later and smoother.
    const Seconds smoothed = fluid.fluid_period / (1.0 - kLaterShare * model_.explained());
    glm::dvec3 rest_n = filter_(gain * unexplained_n, smoothed, dt);
    if (is_finite(rest_n)) {
        // Where it explains nearly all, the rest is the grid that the body crosses, a little at each answer: rounded off twice. The time
        // of the second low-pass is the fourth power of how much that is.
        const double twice = model_.explained() * model_.explained();
        const double again_hz = filter_.cutoff_hz(smoothed) / (twice * twice);
        rest_n = rest_n_ = glm::mix(rest_n_, rest_n, low_pass_weight(again_hz, dt));
    }
    const glm::dvec3 force_n = rest_n + gain * explained_n + damping_n;
    passivity_.given(force_n, damping_n);
    report_ = {.drag_ns_m = gain * scale * model_.drag_ns_m(),
               .added_kg = gain * scale * model_.added_kg(),
               .drag_share = shares.drag,
               .added_share = shares.added,
               .explained = model_.explained(),
               .least_j = passivity_.least_j(),
               .damped = passivity_.damped()};
    return force_n;
}

bool HandForce::is_sound() const {
    return (law_ == ForceLaw::Filter || law_ == ForceLaw::Model) && filter_.is_sound() && hand_.is_sound() &&
           match_.is_sound() && passivity_.is_sound();
}

void HandForce::follow(const HandAtTick& hand, double scale, Seconds dt) {
    if (!hand.known) {
        hand_.forget();
        match_.forget();
        passivity_.begin_anew();
        return;
    }
    const glm::dvec3 handle_m = hand.body_m / scale;
    if (hand.moved_at) hand_.take(handle_m, *hand.moved_at);
    match_.moved_to(handle_m, hand_.velocity_m_s(), hand_.acceleration_m_s2(), dt);
    passivity_.moved_to(handle_m, hand.now);
}

void HandForce::hear(const FluidSnapshot& fluid, const SlopeBounds& bounds, double energy_at_handle) {
    model_.learn({fluid.force_n, fluid.velocity_m_s, fluid.acceleration_m_s2}, fluid.fluid_period, bounds);
    passivity_.received((fluid.received_j - received_j_) * energy_at_handle,
                        fluid.stored_j * energy_at_handle, fluid.computed_for);
    received_j_ = fluid.received_j;
}

}  // namespace eddy
