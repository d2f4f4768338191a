#pragma once
#include <algorithm>

#include "hal/clock.h"

namespace eddy {

// How steep a force may be that a fluid answers one of its periods late and holds for another. A mass m with that drag
// B goes v' = v - B T/m v(one period before), which dies away while B < m / T: the faster the fluid, the more it may
// resist. Two or three periods late, the limit is 0.62 and 0.45 of that, and m over the whole lateness is within it. Its own
// damping and that of the hand allow a little more; half of m / T is what is used. An added mass that comes as late drives the
// handle as soon as it is more than the handle's own, however fast the fluid answers (the added-mass limit of partitioned
// fluid-structure coupling: Causin, Gerbeau, Nobile 2005); again half of that is used.

/// The handle alone, when nobody holds it: the least that moves, assumed on the safe side. One student measured three times as
/// much on a Falcon (hal/haptic/emulated/plant.h); a person's hand and arm add 0.55 kg (van Beek et al. 2015, Scientific
/// Reports 5:18004).
inline constexpr double kHandleMassKg = 0.15;
/// What is used of a limit.
inline constexpr double kStabilityShare = 0.5;

/// A fluid that is faster may resist no more: how fast the handle moves is not known much sooner (motion_tracker.h).
inline constexpr Seconds kShortestPeriod{0.020};
/// Newtons per m/s of the handle.
inline double most_drag_ns_m(Seconds fluid_period) {
    return kStabilityShare * kHandleMassKg / std::max(fluid_period.count(), kShortestPeriod.count());
}
/// Newtons per m/s2 of the handle.
inline constexpr double kMostAddedKg = kStabilityShare * kHandleMassKg;

}  // namespace eddy
