#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "config/scene.h"
#include "gles/fluid/setup.h"
#include "hal/haptic/emulated/recorded_motion.h"

namespace eddy {

/// Where the bodies of a scene are at a time. Held bodies are wherever the hand was last put; without a hand
/// they stay at their centre_m.
class BodySchedule {
  public:
    /// Reads the paths; throws InputError "file:line: ..." if one is wrong.
    explicit BodySchedule(const Scene& scene);

    /// States at the end of a step from time_s - dt_s to time_s. Velocities are those of the displacement
    /// during the step, so that what a body pushes away agrees with where it goes.
    std::vector<gles::BodyState> at(double time_s, double dt_s) const;

    /// Index of the body in the visitor's hand.
    std::optional<std::size_t> held() const { return held_; }

  private:
    glm::dvec3 position_m(std::size_t body, double time_s) const;
    glm::dquat orientation(std::size_t body, double time_s) const;

    std::vector<Scene::Body> bodies_;
    std::vector<std::unique_ptr<emulated::RecordedMotion>> paths_;
    std::optional<std::size_t> held_;
};

}  // namespace eddy
