#pragma once
#include "gles/fluid/setup.h"
#include "hal/clock.h"

namespace eddy {

/// Lets a force go over from one fluid to another without a jump. The last force of the old one stands while the new one
/// settles; what the next answer of that differs by is added to its answers, less and less, for half a second.
class ForceHandover {
  public:
    static constexpr Seconds kFade{0.5};
    /// Answers that are not heeded: yang2009 sees half of any change a step late, and all of it only in the step after.
    static constexpr int kSettling = 2;

    /// The next load is the first of another fluid.
    void begin() { settling_ = any_ ? kSettling + 1 : 0; }
    /// Loads as the fluid gives them, with growing times, and as they are handed on. One that is not finite goes through and
    /// leaves no trace.
    gles::Load hand_on(const gles::Load& load, Seconds time);

  private:
    bool any_ = false;
    int settling_ = 0;  ///< answers to come before the fade goes on by itself
    gles::Load last_{}, difference_{};
    Seconds began_{0.0};
};

}  // namespace eddy
