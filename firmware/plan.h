#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/body_schedule.h"
#include "gles/fluid/setup.h"
#include "gles/gpu.h"

namespace eddy {

/// What passes come to.
struct Work {
    std::int64_t passes = 0, uniforms = 0;            ///< drawn, and set for them
    std::int64_t texels = 0, bytes = 0, fetches = 0;  ///< written, written and read
    void add(const gles::PassRecord& record);
};

/// What a step of a scene comes to, and the textures that exist for it.
struct StepCost {
    Work work;
    std::size_t textures = 0, texture_bytes = 0;
};

/// The passes of one step of this scene in order (inputs, outputs, uniforms, texels, bytes, fetches) and the textures
/// that exist, as a table. Taken from a real step, the third, when everything that happens only once has
/// happened.
std::string plan_of(gles::Gpu& gpu, const gles::FluidSetup& setup, const BodySchedule& motions, double dt_s);

/// The sums of that table. `gpu` must have drawn nothing before, or its textures are counted too.
StepCost cost_of(gles::Gpu& gpu, const gles::FluidSetup& setup, const BodySchedule& motions, double dt_s);

}  // namespace eddy
