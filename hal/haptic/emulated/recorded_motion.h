#pragma once
#include <string_view>
#include <vector>

#include "hal/haptic/emulated/axis_map.h"
#include "hal/haptic/emulated/hand_motion.h"

namespace eddy::emulated {

/// What follows the last sample: the recording again, or its last position for ever.
enum class AtEnd { Loop, Hold };

/// A recorded hand motion, from CSV text: comment lines begin with '#', then the line  t_s,x_m,y_m,z_m , then
/// samples in order of time, at any spacing. Between samples it follows cubics through them with continuous
/// velocity; a motion that is a polynomial of degree three is reproduced exactly.
class RecordedMotion final : public HandMotion {
  public:
    /// `name` stands in messages. Throws std::runtime_error "name:line: what is wrong, and what to do".
    RecordedMotion(std::string_view csv, std::string_view name, const AxisMap& axes, AtEnd at_end);

    /// A loop passes from its end into its beginning by fading from one to the other, over a second at most.
    /// Before the first sample, and after a held last one, the hand stands still.
    glm::dvec3 position_m(Seconds t) const override;

    /// From the first sample to the last; the first sample is at time 0.
    Seconds duration() const { return Seconds(samples_.back().t); }

  private:
    struct Sample {
        double t;             // [s]
        glm::dvec3 position;  // [m, Device]
        glm::dvec3 velocity;  // [m/s]; zero until all samples are read
    };

    void read(std::string_view csv, std::string_view name, const AxisMap& axes);
    void estimate_velocities();
    glm::dvec3 at(double t) const;

    std::vector<Sample> samples_;
    AtEnd at_end_;
};

}  // namespace eddy::emulated
