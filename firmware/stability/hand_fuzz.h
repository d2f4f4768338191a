#pragma once
#include <cstdint>
#include <set>
#include <string>

#include "config/scene.h"
#include "firmware/haptic/force_gate.h"
#include "gles/gpu.h"
#include "hal/clock.h"

namespace eddy::stability {

struct HandFuzzFigures {
    std::string violation = {};  ///< of the rule's terms about forces and finite fields (rule.h); empty: none
    double most_n = 0.0;         ///< sent to the hand
    std::set<GateReason> reasons = {};  ///< that the gate had for what it sent
    long ticks = 0, steps = 0;
    GateCounters gate = {};
};

/// The exhibit with a hand that chance moves (random_hand.h), on virtual time: the show, the loop, its law and gate as they are.
/// Chance also makes ticks late and fluid updates late or many, switches the force off and on, and sets the gain. The seed
/// decides it all, the same on every machine with the same driver. Every other seed has a filter that lets everything through:
/// the gate must do without.
HandFuzzFigures play_random_hand(gles::Gpu& gpu, const Scene& scene, std::uint64_t seed, Seconds duration);

}  // namespace eddy::stability
