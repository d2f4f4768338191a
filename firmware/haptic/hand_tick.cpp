#include "firmware/haptic/hand_tick.h"

#include "firmware/haptic/sound.h"

namespace eddy {

HandState hand_state(const HapticLoopSettings& settings) {
    HandState state;
    state.law.force = HandForce(settings.law, settings.filter);
    state.law.gate = ForceGate(settings.gate);
    return state;
}

bool is_sound(const HandState& state) {
    const LawState& law = state.law;
    return state.dead_man.is_sound() && law.hand.is_sound() && law.force.is_sound() && law.gate.is_sound() &&
           is_sound(law.answered) && is_sound(law.fluid_arrived);
}

LawOutput hand_tick(HandState& state, HapticInput in, Seconds dt) {
    const bool wanted = in.orders.enabled;
    const GateReason held_by = state.dead_man(in);
    in.orders.enabled = wanted && held_by == GateReason::Open;
    LawOutput out = law(state.law, in, dt);
    // The gate knows only that it is shut; whoever shut it says why.
    if (out.reason == GateReason::Disabled && held_by != GateReason::Open) out.reason = held_by;
    return out;
}

}  // namespace eddy
