#pragma once
#include <functional>
#include <optional>

#include "gles/fluid/diffusion.h"
#include "gles/fluid/resample.h"
#include "gles/fluid/transport.h"

namespace eddy::gles {

/// A quantity with one value in each cell that goes with the flow, smoke or heat: its field, and what happens to
/// it in a step.
class Scalar {
  public:
    static std::optional<ScalarSetup> smoke(const FluidSetup& setup);
    static std::optional<ScalarSetup> temperature(const FluidSetup& setup);

    /// `fractions`: null when nothing solid is in the tank. Must outlive this.
    Scalar(Gpu& gpu, const FluidSetup& setup, const ScalarSetup& scalar, const Walls& walls,
           const Fractions* fractions);

    /// Back to the start.
    void reset();
    /// That of another fluid; null: back to the start.
    void take_over(const Field<Cells>* from, Resample& resample);
    /// Moves on by dt_s with velocity u. `time_s`: when the step begins.
    void step(const Field<Faces>& u, double time_s, double dt_s, const Uniform& wall_time);
    const Field<Cells>& field() const { return field_; }

  private:
    Gpu* gpu_;
    double cell_m_;
    ScalarSetup setup_;
    Field<Cells> field_;
    ScalarTransport transport_;
    std::optional<Diffusion> diffusion_;
};

}  // namespace eddy::gles
