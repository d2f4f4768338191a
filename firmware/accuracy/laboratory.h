#pragma once
#include <string>
#include <vector>

#include "config/scene.h"
#include "firmware/accuracy/face_velocity.h"
#include "firmware/body_schedule.h"
#include "firmware/progress.h"
#include "gles/gpu.h"

namespace eddy::accuracy {

/// A scene under way.
class Run {
  public:
    /// `step_ms`: where the wall time of each step goes, its result waited for.
    Run(gles::Gpu& gpu, const Scene& scene, std::vector<double>& step_ms, Progress& progress);

    /// One step. The result holds the loads on the bodies whose force is measured.
    gles::StepResult step();
    /// All that are left until the scene's end; the last result. `after_each` may be empty.
    gles::StepResult step_to_end(const std::function<void(const gles::StepResult&)>& after_each = {});
    /// From now on results hold gles::Diagnostics too, which cost a pass over the grid.
    void diagnose() { diagnose_ = true; }

    double time_s() const;
    double dt_s() const { return dt_s_; }
    long steps() const { return steps_; }  ///< of the whole run
    FaceVelocity velocity() const { return FaceVelocity(*fluid_); }
    const gles::Fluid& fluid() const { return *fluid_; }
    const gles::FluidSetup& setup() const { return fluid_->setup(); }

  private:
    std::unique_ptr<gles::Fluid> fluid_;
    BodySchedule motions_;
    double dt_s_;
    long steps_;
    bool measures_ = false, diagnose_ = false;
    std::vector<double>& step_ms_;
    Progress& progress_;
};

/// Where a case runs its scene on one grid, as often and as varied as it needs.
class Laboratory {
  public:
    /// `label`: what the progress line says.
    Laboratory(gles::Gpu& gpu, Scene scene, std::string label);

    /// The case's scene on this grid.
    const Scene& scene() const { return scene_; }
    Run start() { return start(scene_); }
    /// A variation of it.
    Run start(const Scene& scene) { return Run(gpu_, scene, step_ms_, progress_); }
    /// Where it runs.
    gles::Gpu& gpu() { return gpu_; }
    /// Of every step of every run.
    const std::vector<double>& step_ms() const { return step_ms_; }

  private:
    gles::Gpu& gpu_;
    Scene scene_;
    std::vector<double> step_ms_;
    Progress progress_;
};

}  // namespace eddy::accuracy
