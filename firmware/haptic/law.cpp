#include "firmware/haptic/law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/haptic/soft_wall.h"

namespace eddy {
namespace {

/// The hand as the fluid sees it: carried into the tank and kept inside the bounds.
PoseSnapshot pose_in_tank(const LawState& state, const HapticInput& in, bool known) {
    const HapticOrders& orders = in.orders;
    const glm::dvec3 wanted = orders.tank_from_device.position(state.hand.position_m());
    const glm::dvec3 inside = glm::min(glm::max(wanted, orders.lowest_m), orders.highest_m);
    // Against a bound the body stands still, whatever the handle does: its velocity is that of the place it
    // is shown at.
    const glm::dvec3 free = glm::dvec3(glm::equal(wanted, inside));
    return {.position_m = inside,
            .velocity_m_s = free * orders.tank_from_device.velocity(state.hand.velocity_m_s()),
            .sequence = state.ticks,
            .time = in.now,
            .buttons = state.buttons,
            .known = known};
}

/// Where the fluid is told that the body is: between the encoders' counts, and against a bound exactly there.
glm::dvec3 told_m(const HandForce& force, const glm::dvec3& body_m, const HapticOrders& orders) {
    const glm::dvec3 between = force.between_counts(body_m, orders.tank_from_device.scale);
    const glm::dvec3 free = glm::dvec3(glm::greaterThan(body_m, orders.lowest_m)) *
                            glm::dvec3(glm::lessThan(body_m, orders.highest_m));
    return glm::mix(body_m, glm::min(glm::max(between, orders.lowest_m), orders.highest_m), free);
}

/// Age counts from arrival, not from computed_for: solving and reading back take two fluid periods of their
/// own, and a fluid that answers steadily, however late, is alive.
bool is_stale(const FluidSnapshot& fluid, Instant age) {
    const Seconds periods = kFluidPeriodsAllowed * fluid.fluid_period;
    const Seconds allowed = std::isfinite(periods.count()) ? std::max(kFluidTimeout, periods) : kFluidTimeout;
    // guard stale_force
    return fluid.sequence == 0 || Seconds(age) > allowed;
}

}  // namespace

LawOutput law(LawState& state, const HapticInput& in, Seconds dt) {
    ++state.ticks;
    const bool reset = in.orders.resets != state.resets;
    state.resets = in.orders.resets;

    // The hand. A reading that is not finite is not taken; the gate hears of it by a speed that is not finite
    // either.
    if (reset) state.answered = false;
    const bool sound = !in.reading || state.hand.take(*in.reading);
    if (in.reading && sound) {
        state.buttons = in.reading->buttons;
        state.answered = true;
    }
    const bool ready = in.device == HapticState::Ready && state.answered;
    // A tick that comes late finds an old reply, for nobody asked in between: the loop's own lateness is not the
    // device's silence.
    const Seconds lateness = std::max(Seconds(0.0), dt - kNominalTick);
    const bool silent = state.answered && in.silence - lateness >= kReplyTimeout;
    if (!ready || silent) state.hand.forget();

    // The fluid's newest answer, held until the next.
    const bool fresh = in.fluid.sequence != state.fluid_sequence;
    if (fresh) {
        state.fluid_sequence = in.fluid.sequence;
        state.fluid_arrived = in.now;
    }

    LawOutput out;
    out.fluid_age = in.now - state.fluid_arrived;
    out.raw_n = in.orders.gain * in.fluid.force_n;
    out.pose = pose_in_tank(state, in, ready && !silent);
    const HandAtTick hand{
        .now = in.now,
        .known = out.pose.known,
        .moved_at = in.reading && sound ? std::optional(in.reading->taken_at) : std::nullopt,
        .body_m = out.pose.position_m};
    out.filtered_n = state.force(in.fluid, fresh, in.orders, hand, dt) +
                     soft_wall_n(in.orders, state.hand.position_m(), state.hand.velocity_m_s());
    if (out.pose.known) out.pose.position_m = told_m(state.force, out.pose.position_m, in.orders);
    const GateInput gate{.force_n = out.filtered_n,
                         .most_n = in.orders.most_n,
                         .speed_m_s = sound ? glm::length(state.hand.velocity_m_s())
                                            : std::numeric_limits<double>::quiet_NaN(),
                         .enabled = in.orders.enabled,
                         .device_ready = ready,
                         .device_silent = silent,
                         .device_unsure = !in.obeys,
                         .fluid_stale = is_stale(in.fluid, out.fluid_age),
                         .reset = reset};
    out.force_n = state.gate(gate, dt);
    out.reason = state.gate.reason();
    if (out.reason > GateReason::Starting) state.force.interrupted();
    return out;
}

}  // namespace eddy
