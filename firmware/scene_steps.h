#pragma once
#include <memory>

#include "firmware/body_schedule.h"
#include "gles/fluid/fluid.h"

namespace eddy {

/// A scene that takes steps of its own length for their own sake: to see what one costs.
class SceneSteps {
  public:
    SceneSteps(gles::Gpu& gpu, const Scene& scene);

    /// Asks the GPU for the next one.
    void take(bool diagnose = false);
    /// What came of the oldest step not yet waited for. Throws GlError if the GPU has stopped answering.
    gles::StepResult wait();

  private:
    BodySchedule motions_;
    std::unique_ptr<gles::Fluid> fluid_;
    double dt_s_;
};

}  // namespace eddy
