#pragma once
#include <optional>
#include <span>

#include "firmware/haptic_study/rig.h"

namespace eddy::haptic_study {

/// Forces a millisecond apart, over whole seconds.
using Forces = std::span<const glm::dvec3>;

double rms(Forces forces);
/// The rms of what lies from 10 to 400 Hz.
double trembling(Forces forces);
/// How far the first is behind the second, as the 1 Hz part of both has it, for a hand on a circle in x and y [s].
double lag_s(Forces forces, Forces reference);
/// From a start to half of the way from the force along x then to that over the last 100 ms [s]; nothing if it never gets there.
std::optional<double> half_rise_s(Forces forces);

/// How far the felt force is from the one that was given, whatever its direction, as a share of the latter.
double pull_error(const glm::dvec3& felt_n, const glm::dvec3& given_n);

/// What the hand spent on `ticks` and got back, net [J].
double spent_j(std::span<const Felt> ticks);

/// How much something swings about its own slow course, a parabola: half its largest excursion in any direction.
struct Swing {
    double force_n = 0.0;
    double position_m = 0.0;
};
Swing swing(std::span<const Felt> ticks);
/// At most 0.05 N and 0.1 mm, or twice what a flow makes of it: a handle that a flow shakes is no limit cycle.
bool rests(const Swing& found, const Swing& flow = {});

}  // namespace eddy::haptic_study
