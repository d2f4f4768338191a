#pragma once
#include <optional>
#include <vector>

#include "firmware/haptic/loop.h"
#include "firmware/haptic_study/handle.h"
#include "firmware/haptic_study/study_fluid.h"

namespace eddy::haptic_study {

/// What a hand did and felt in a tick.
struct Felt {
    glm::dvec3 position_m{0.0};  ///< where the handle really is when the force is given
    glm::dvec3 force_n{0.0};
};

struct Play {
    std::vector<Felt> ticks;             ///< a millisecond each, from 0
    std::vector<FluidSnapshot> answers;  ///< as they reached the loop
    HapticOrders orders;
    LoopReport report;
};

struct Order {
    ForceLaw law = ForceLaw::Model;
    double rate_hz = 50.0;  ///< of the fluid; each answer is a period late
    Seconds duration{4.0};
    std::optional<Seconds> let_go{};
};

/// The haptic loop with a handle and a fluid on virtual time, as eddy run --clock stepped has them.
Play play(StudyFluid& fluid, Handle& handle, const Order& order);

}  // namespace eddy::haptic_study
