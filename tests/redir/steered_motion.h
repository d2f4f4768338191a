#pragma once
#include <memory>

#include "hal/haptic/emulated/hand_motion.h"

namespace eddy::redir {

/// A hand that follows a path until it is told otherwise: to stay somewhere, or to home the handle, as a person does: all the
/// way out, then all the way in. From one to the other it goes as people reach, in half a second.
class SteeredMotion final : public emulated::HandMotion {
  public:
    explicit SteeredMotion(std::unique_ptr<emulated::HandMotion> path) : path_(std::move(path)) {}

    /// [m, Device frame]
    void hold(Instant now, const glm::dvec3& place_m);
    /// Takes the path up again, where it is by now.
    void follow(Instant now);
    /// Out, in, and on with the path.
    void home(Instant now);
    bool homing(Instant now) const;

    glm::dvec3 position_m(Seconds t) const override;

  private:
    enum class Aim { Path, Place, Home };
    void turn_to(Aim aim, Instant now);
    glm::dvec3 aim_at(Seconds t) const;

    std::unique_ptr<emulated::HandMotion> path_;
    Aim aim_ = Aim::Path;
    Seconds since_{-1e9};
    glm::dvec3 from_{0.0};   // where it was when it was told [m]
    glm::dvec3 place_{0.0};  // [m]
};

}  // namespace eddy::redir
