#pragma once
#include <memory>
#include <optional>

#include "firmware/body_schedule.h"
#include "firmware/quality/force_error.h"
#include "firmware/quality/tuning.h"
#include "firmware/step_timer.h"

namespace eddy {

/// Finds out what this machine can do with a scene: keeps its preset and its time step, and tries grids and iterations of the
/// pressure, each by its time per step of the scene and by the force on a ball, as many cells across as the body in the hand, that
/// speeds up. Works in small pieces, so that
/// an exhibit goes on showing something meanwhile. GL thread only.
class Tuner {
  public:
    Tuner(gles::Gpu& gpu, const Scene& scene);

    bool done() const { return series_ == iterations_.size(); }
    /// A piece: one step, or one fluid made, its shaders compiled and its first steps taken. Throws if nothing at all can be used.
    void work();
    /// What it is at, "fast 48^3, 2 cycles"; empty when done.
    std::string doing() const;
    /// Settings tried or passed over so far, of how many there are.
    std::size_t tried() const { return series_ * grids_.size() + grid_; }
    std::size_t most_to_try() const { return iterations_.size() * grids_.size(); }
    /// Complete when done.
    const Tuning& tuning() const { return tuning_; }

  private:
    Quality candidate() const;
    /// To the next grid, or the next series if this one has become too slow.
    void go_on(bool too_slow);
    void make_fluid();
    void take_a_step();
    void finish_candidate();

    gles::Gpu& gpu_;
    Scene scene_;
    double half_width_share_;
    Tuning tuning_;
    std::vector<int> iterations_;  ///< a series each, on growing grids
    std::vector<int> grids_;
    std::size_t series_ = 0, grid_ = 0;

    // --- of the candidate at hand
    std::optional<ForceError> error_;
    std::unique_ptr<gles::Fluid> fluid_;
    std::optional<BodySchedule> motions_;
    std::optional<StepTimer> timer_;
};

}  // namespace eddy
