#pragma once
#include "firmware/haptic/dead_man.h"
#include "firmware/haptic/law.h"

namespace eddy {

struct HapticLoopSettings {
    ForceLaw law = ForceLaw::Model;
    ForceFilterSettings filter{};
    GateLimits gate{};
};

/// All that one tick leaves to the next.
struct HandState {
    DeadMan dead_man{};
    LawState law{};
};
HandState hand_state(const HapticLoopSettings& settings);
/// The bytes of a state are one that hand_tick() can go on from (sound.h).
bool is_sound(const HandState& state);

/// What is pure in a tick of the loop: the dead man's switch, then the law. Same state and input, same output, bit for bit.
LawOutput hand_tick(HandState& state, HapticInput in, Seconds dt);

}  // namespace eddy
