#pragma once
#include <cstdint>

namespace eddy {

/// How the force of a fluid that answers some ten times a second becomes one that is given a thousand times a second.
enum class ForceLaw {
    Filter,  ///< held and low-passed: Yang, Lu, Safonova and Kuchenbecker 2009
    Model  ///< what follows from the hand's own motion at once, only the rest low-passed; the energy watched
};

/// What the model knows, and what it took to keep the energy right.
struct ForceReport {
    double drag_ns_m = 0.0;  ///< slopes in use, at the handle, after gain
    double added_kg = 0.0;
    double drag_share = 1.0;  ///< of these, what the hand is given (energy_match.h)
    double added_share = 1.0;
    double explained = 0.0;    ///< part of the force's changes that these account for
    double least_j = 0.0;      ///< the deepest debt since start
    std::uint64_t damped = 0;  ///< ticks with damping
};

}  // namespace eddy
