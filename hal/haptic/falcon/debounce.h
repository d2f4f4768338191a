#pragma once
#include <cstdint>

#include "hal/clock.h"

namespace eddy::falcon {

/// Buttons as pressed by a finger rather than by a bouncing contact: a change counts once it has lasted. The
/// Falcon's contacts jitter so much that one of its drivers gave up on them (gborghesan/novint_falcon).
class Debounce {
  public:
    static constexpr Instant kHold = std::chrono::milliseconds(6);

    std::uint8_t push(std::uint8_t buttons, Instant at) {
        if (buttons != candidate_) {
            candidate_ = buttons;
            since_ = at;
        } else if (at - since_ >= kHold) {
            settled_ = buttons;
        }
        return settled_;
    }

  private:
    std::uint8_t settled_ = 0;
    std::uint8_t candidate_ = 0;
    Instant since_{0};
};

}  // namespace eddy::falcon
