#pragma once
#include <optional>

#include "hal/clock.h"

namespace eddy::kms {

/// Watches that frames which were sent come onto the screen, and says what to try when they do not: set the mode again, then
/// open the card again, then give up. The same trouble within ten seconds of the last cure is not cured by it.
class FlipWatch {
  public:
    enum class Cure { None, SetMode, Reopen, GiveUp };

    /// A frame should come onto the screen from now on. Sent again before one did, it is still overdue since the first.
    void expect(Instant now) {
        if (!since_) since_ = now;
    }
    /// One did.
    void flipped(Instant now);
    /// Nothing is on its way any more, and that is as it should be.
    void forget() { since_.reset(); }
    /// From the start: another card, another monitor.
    void begin_again() { *this = {}; }

    /// What is due now; each is said once, and counts as a frame that was sent.
    Cure due(Instant now);

  private:
    std::optional<Instant> since_;
    Cure last_ = Cure::None;
    std::optional<Instant> well_since_;  ///< frames have come since then
};

}  // namespace eddy::kms
