#pragma once
#include <atomic>

#include "hal/clock.h"

namespace eddy {

/// The stop input, as whoever looks at its line found it last. That it is let go has to be said again and again: who falls silent, as on
/// a bridge that hangs, has pressed it. One thread says, any may ask; nobody waits. All of them go by one clock.
class StopInput {
  public:
    /// A look that found it let go counts for so long.
    static constexpr Instant kLookCounts = std::chrono::milliseconds(500);

    /// Not wired: it is never pressed. Wired: it is, until somebody has looked.
    explicit StopInput(bool wired) : let_go_until_((wired ? Instant::min() : Instant::max()).count()) {}

    /// What a look at `now` found.
    void found(bool pressed, Instant now) {
        let_go_until_.store((pressed ? Instant::min() : now + kLookCounts).count(),
                            std::memory_order_relaxed);
    }
    bool pressed(Instant now) const { return now.count() > let_go_until_.load(std::memory_order_relaxed); }

  private:
    static_assert(std::atomic<Instant::rep>::is_always_lock_free);
    std::atomic<Instant::rep> let_go_until_;
};

}  // namespace eddy
