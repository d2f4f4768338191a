#pragma once
#include <memory>

#include "config/scene.h"
#include "gles/fluid/fluid.h"
#include "gles/gpu.h"

namespace eddy::accuracy {

/// A ball at rest in water at rest speeds up by U in each step: the water it takes along is pushed by F dt = -C_m rho V U.
/// The first step of the movement is not judged, as yang2009 sees half of any change in the step after it; the worst of the
/// next three is, as what the iterations leave of one step comes out in the next and may make up for the error of the
/// grid there. A step at rest comes before all that: the first step of a fluid takes more cycles than those that are timed.
class SetOff {
  public:
    /// Where in a cell the middle of the ball lies, along a diagonal; C_m hardly changes by that (image dipoles: 1e-4).
    static constexpr int kPlaces = 4;
    using ForceOn = glm::dvec3 (*)(const gles::Fluid& fluid, const gles::StepResult& result);
    static glm::dvec3 on_surface(const gles::Fluid& fluid, const gles::StepResult& result);

    /// `box`: the scene of case B2-box, on a grid and with a solver of its own; `place`: 0 .. kPlaces - 1.
    SetOff(gles::Gpu& gpu, Scene box, int place, ForceOn force = on_surface);

    bool done() const { return steps_ == 5; }
    void step();
    /// Of the force, as a share of it.
    double error() const { return error_; }

  private:
    double dt_s_;
    glm::dvec3 exact_n_;
    ForceOn force_;
    std::unique_ptr<gles::Fluid> fluid_;
    std::vector<gles::BodyState> bodies_;
    int steps_ = 0;
    double error_ = 0.0;
};

}  // namespace eddy::accuracy
