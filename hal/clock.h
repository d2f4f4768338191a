#pragma once
#include <chrono>

namespace eddy {

using Seconds = std::chrono::duration<double>;
/// Time since the clock was made. Integer nanoseconds, so that a stepped run adds up exactly.
using Instant = std::chrono::nanoseconds;

/// Where a loop takes its time from. Both loops (fluid and haptic) use nothing else, so that a run on the
/// stepped clock is a pure function of its input.
class Clock {
  public:
    virtual ~Clock() = default;
    /// Time since start; never goes back. Any thread.
    virtual Instant now() const = 0;
    /// Returns when now() >= t; at once if that has passed.
    virtual void sleep_until(Instant t) = 0;
};

/// The monotonic clock of the machine; sleep_until uses absolute time, so that periods do not drift.
class RealClock final : public Clock {
  public:
    RealClock();
    Instant now() const override;
    void sleep_until(Instant t) override;

  private:
    std::chrono::steady_clock::time_point start_;
};

/// Virtual time: stands still until told to move; sleep_until jumps. One thread only.
class SteppedClock final : public Clock {
  public:
    Instant now() const override { return now_; }
    void sleep_until(Instant t) override { now_ = t > now_ ? t : now_; }

  private:
    Instant now_{0};
};

}  // namespace eddy
