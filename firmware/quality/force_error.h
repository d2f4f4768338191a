#pragma once
#include <memory>

#include "firmware/accuracy/set_off.h"
#include "firmware/quality/quality.h"

namespace eddy {

/// Half the least width of the body in the hand, or of the first whose force is measured, over the longest side of the tank; that
/// of the ball of case B2-box without any.
double half_width_share(const Scene& scene);

/// Measures how far off the force is when a scene is computed with some quality: that on a ball, as many cells across as the
/// scene's body, that speeds up. Works in small pieces. GL thread only.
class ForceError {
  public:
    /// `half_width_share`: of the scene.
    ForceError(gles::Gpu& gpu, const Scene& scene, const Quality& quality, double half_width_share);

    bool done() const { return place_ == accuracy::SetOff::kPlaces; }
    /// A piece: one step, or one fluid made and its shaders compiled.
    void work();
    /// Share of the force; the worst of all places when done.
    double error() const { return error_; }

  private:
    gles::Gpu& gpu_;
    Scene box_;
    int place_ = 0;
    std::unique_ptr<accuracy::SetOff> ball_;
    double error_ = 0.0;
};

}  // namespace eddy
