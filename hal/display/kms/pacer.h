#pragma once
#include <array>
#include <optional>

#include "hal/clock.h"

namespace eddy::kms {

/// Notices a driver whose page flips do not wait for the screen's refresh (virtio-gpu: 99 a second on a mode of 75 Hz), and
/// then says when the next frame is due.
class Pacer {
  public:
    explicit Pacer(Instant period = Instant(0)) : period_(period) {}

    /// A frame came onto the screen at `time`, having been sent at `sent`.
    void flipped(Instant sent, Instant time);
    /// Whether it came later than one and a half periods after it was sent, or after the one before it if that was later.
    bool was_late() const { return late_; }
    /// Whether the driver is none of those: its flips wait for the refresh.
    bool driver_paces() const { return !unpaced_; }
    /// When the next frame may be sent; no time: at once.
    std::optional<Instant> next() const;

  private:
    Instant period_;
    std::optional<Instant> last_;
    std::optional<Instant> due_;
    int fast_ = 0, seen_ = 0;  // flips much sooner than a period after the one before, of those seen
    bool unpaced_ = false, late_ = false;
};

}  // namespace eddy::kms
