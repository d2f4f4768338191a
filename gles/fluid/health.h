#pragma once
#include <optional>

#include "gles/field.h"
#include "gles/fluid/step_guard.h"
#include "gles/row_sum.h"

namespace eddy::gles {

/// Looks through the flow and what it carries, as a step finds them: how many texels cannot be (not a number, not
/// finite, beyond step_guard.h's Sound), and how fast the fluid is. Each texel is read once: at 64^3, 0.38 million fetches
/// of a step's 13, and 0.26 for smoke.
class HealthCheck {
  public:
    /// `velocity`, `phi`: the layouts they have in this solver; none where the flow is given.
    HealthCheck(Gpu& gpu, const FluidSetup& setup, const AtlasLayout& velocity, const AtlasLayout& phi);
    HealthCheck(Gpu& gpu, const FluidSetup& setup);

    struct State {
        const Texture* velocity = nullptr;
        const Texture* phi = nullptr;
        const Texture* diffused = nullptr;  ///< in a viscous fluid on faces; null before there is one
        const Field<Cells>* smoke = nullptr;
        const Field<Cells>* temperature = nullptr;
    };
    /// Writes into the texel of `row` that Results sets aside for it.
    void draw(const State& state, const Sound& sound, const Texture& row);

  private:
    HealthCheck(Gpu& gpu, const FluidSetup& setup, const glm::ivec3& texels, Variant variant);

    Gpu* gpu_;
    glm::ivec2 to_;  ///< texel of the row
    RowSum count_;
};

}  // namespace eddy::gles
