#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "hal/clock.h"

namespace eddy {

/// How much a force trembles: what is left of it without its mean over 0.2 s (0.1 s to each side of a moment), as the rms
/// of the last two seconds. The hand moves a few times a second, which that mean follows; what the grid adds as the body
/// crosses it is quicker. Between two forces it takes the line from one to the other, so they may come at any intervals.
class ForceRipple {
  public:
    ForceRipple();

    /// The force at a time; times must grow. One that does not, or that leaves a gap of more than 0.2 s, starts anew.
    /// Beyond 1000 forces a second the window is shorter than two seconds.
    void add(Seconds time, const glm::dvec3& force);

    struct Figures {
        double rms = 0.0;    ///< in the force's unit; of a vector: of its length
        double share = 0.0;  ///< of the mean of |force| over the same time
    };
    /// Nothing until enough is known: about two seconds at 12 forces a second, half of one at 60. Slower than that a
    /// mean over 0.2 s has nothing to tell apart.
    std::optional<Figures> figures() const;

    void reset() { count_ = 0; }

  private:
    struct Sample {
        double time_s = 0.0;
        glm::dvec3 force{0.0};
    };
    /// The i-th oldest.
    const Sample& at(std::size_t i) const { return ring_[(first_ + i) % ring_.size()]; }

    std::vector<Sample> ring_;
    std::size_t first_ = 0, count_ = 0;
};

}  // namespace eddy
