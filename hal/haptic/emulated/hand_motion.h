#pragma once
#include <glm/glm.hpp>

#include "hal/clock.h"

namespace eddy::emulated {

/// The path of an emulated visitor's hand.
class HandMotion {
  public:
    virtual ~HandMotion() = default;
    /// Where the hand wants to be at time t [m, Device frame (hal/frames.h)]; for every t, also before 0.
    /// Does not allocate.
    virtual glm::dvec3 position_m(Seconds t) const = 0;
};

}  // namespace eddy::emulated
