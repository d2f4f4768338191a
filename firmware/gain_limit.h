#pragma once
#include "config/scene.h"
#include "gles/body/bounds.h"
#include "gles/fluid/fluid.h"
#include "hal/clock.h"

namespace eddy {

/// How steeply a fluid answers the body in the visitor's hand, before gain, along the axis where it does so most; a ball alone in the
/// tank, along the one with most room.
struct FluidSlopes {
    double drag_ns_m = 0.0;  ///< at the speed of a hand that stirs briskly
    double added_kg = 0.0;
};

/// Found by moving the held body of the scene in its fluid, which must be at its start and is left anywhere else: where the handle's
/// middle is if that is away from other bodies, and never beyond `room`, where its centre may be [m]. Nothing is held, or it has no
/// room: all 0.
FluidSlopes measure_slopes(gles::Fluid& fluid, const Scene& scene, const gles::Extent& room);

/// The newtons on the hand per newton on the body that the loop stands, whoever holds the handle, when the fluid answers so often
/// (haptic/stability_limits.h). Infinite for a fluid that does not resist.
double most_gain(const FluidSlopes& slopes, double workspace_scale, Seconds fluid_period);

}  // namespace eddy
