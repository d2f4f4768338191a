#pragma once
#include <array>

#include "gles/fluid/fluid.h"
#include "gles/gpu.h"
#include "gles/readback.h"

namespace eddy::gles {

/// The few numbers a step leaves on the GPU, and their way back to SI units: one row of texels, two for each
/// body (force, then moment, as Traction writes them), one for the diagnosis of the whole tank, where there is
/// heat one more, and one for the health of the fluid.
class Results {
  public:
    Results(Gpu& gpu, const FluidSetup& setup);

    /// Texels of the row.
    static int width(const FluidSetup& setup);
    /// Where the force on body i goes; its moment goes beside it.
    static glm::ivec2 load_texel(int body) { return {2 * body, 0}; }
    /// Where the diagnosis goes: max |div u| after, sum |u|^2, sum of smoke, max |div u| before; m/s and cells.
    static glm::ivec2 diagnosis_texel(const FluidSetup& setup) {
        return {2 * static_cast<int>(setup.bodies.size()), 0};
    }
    /// Where the sum of the temperature goes.
    static glm::ivec2 heat_texel(const FluidSetup& setup) {
        return diagnosis_texel(setup) + glm::ivec2(1, 0);
    }
    /// Where HealthCheck counts: unsound texels of velocity, of pressure, of scalars; max |u|.
    static glm::ivec2 health_texel(const FluidSetup& setup) { return {width(setup) - 1, 0}; }
    /// Whether the force or torque on any body is asked for.
    static bool measures(const FluidSetup& setup);

    const Texture& row() const { return *row_; }
    /// Starts the row of this step on its way back.
    void request(long step, double dt_s, bool diagnosed);
    /// The oldest row under way. Without `wait`: only if the GPU has finished it.
    std::optional<StepResult> take(bool wait);
    /// Waits for what is under way and drops it.
    void forget();

  private:
    const FluidSetup* setup_;
    TexturePool::Lease row_;
    Readback readback_;
    /// What turns the numbers of a step under way into SI, and whether it was diagnosed.
    struct Asked {
        double dt_s;
        bool diagnosed;
    };
    std::array<Asked, 8> asked_{};
};

}  // namespace eddy::gles
