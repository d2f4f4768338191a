#pragma once
#include <cstdint>
#include <vector>

#include "hal/haptic/emulated/hand_motion.h"

namespace eddy::emulated {

struct PersonSettings {
    std::uint64_t seed = 1;
    glm::dvec3 centre_m{0.0, 0.0, 0.0};  ///< of the box the hand stays in, Device frame
    glm::dvec3 half_size_m{0.040, 0.040,
                           0.025};  ///< of the box; well inside what the Falcon's handle can reach
};

/// A person who plays with the exhibit: reaches, stirs, pauses, in an order and with sizes that the seed
/// decides. Velocity and acceleration are continuous. The same seed gives the same motion on every machine.
/// After two minutes it repeats.
class PersonMotion final : public HandMotion {
  public:
    explicit PersonMotion(const PersonSettings& settings);

    glm::dvec3 position_m(Seconds t) const override;

  private:
    struct Segment {
        double start;       // [s]
        double duration;    // [s]
        glm::dvec3 from;    // [m]
        glm::dvec3 to;      // [m]; a reach goes there straight; a pause and a stir end where they began
        glm::dvec3 centre;  // of a stir
        glm::dvec3 across;  // of a stir: from + (to the centre) and this span the circle      [m]
        double turns;       // of a stir; 0 for the others
    };

    std::vector<Segment> segments_;
    double period_ = 0.0;  // [s]
};

}  // namespace eddy::emulated
