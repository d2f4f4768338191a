#pragma once
#include <string>

#include "firmware/body_schedule.h"
#include "gles/fluid/setup.h"
#include "gles/gpu.h"

namespace eddy {

/// The passes of one step of this scene in order (inputs, outputs, texels, bytes, fetches) and the textures
/// that exist, as a table. Taken from a real step, the third, when everything that happens only once has
/// happened.
std::string plan_of(gles::Gpu& gpu, const gles::FluidSetup& setup, const BodySchedule& motions, double dt_s);

}  // namespace eddy
