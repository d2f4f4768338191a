#pragma once
#include <functional>
#include <optional>

#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/fluid/walls.h"
#include "gles/pass.h"

namespace eddy::gles {

/// Carries the velocity with itself: u* = u(x - dt u). At second order in time, with another one.
class VelocityTransport {
  public:
    VelocityTransport(Gpu& gpu, const FluidSetup& setup, const Walls& walls);
    /// `carrier`: u itself, unless time_order is 2.
    Field<Faces> operator()(const Field<Faces>& u, const Field<Faces>& carrier, double dt_s,
                            const Uniform& wall_time);

  private:
    Gpu* gpu_;
    double cell_m_;
    std::optional<Pass> forward_, correct_;
};

/// What the flow carries: smoke, heat.
struct ScalarSetup {
    const char* name = "";  ///< of its passes
    /// At the start at a place of the tank [m]; empty: 0.
    std::function<double(const glm::dvec3&)> at_start{};
    double SourceSetup::*from_source = nullptr;  ///< how much of it a source adds per second
    double fading_1_s = 0.0;                     ///< exponential decay rate
    double diffusivity_m2_s = 0.0;
};

/// Carries a scalar with a velocity, lets it fade, and adds what the sources give.
class ScalarTransport {
  public:
    ScalarTransport(Gpu& gpu, const FluidSetup& setup, const ScalarSetup& scalar, const Walls& walls);
    /// `time_s`: when the step begins; decides which sources run.
    Field<Cells> operator()(const Field<Cells>& s, const Field<Faces>& u, double time_s, double dt_s,
                            const Uniform& wall_time);

  private:
    Gpu* gpu_;
    double cell_m_;
    ScalarSetup scalar_;
    std::vector<SourceSetup> sources_;  ///< those that give any of it
    std::vector<Box> source_boxes_;
    std::vector<glm::vec4> source_balls_;
    std::optional<Pass> forward_, correct_;
    std::optional<Pass> with_sources_;  ///< the last pass again, over the sources
};

/// Whether a source gives anything at this time.
bool is_running(const SourceSetup& source, double time_s);
/// The ball of a source in cells (centre, radius), and the cells it may touch.
glm::vec4 ball_cells(const SourceSetup& source, double cell_m);
Box ball_box(const glm::vec4& ball, const glm::ivec3& limit);

}  // namespace eddy::gles
