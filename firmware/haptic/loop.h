#pragma once
#include <atomic>

#include "firmware/haptic/exchange.h"
#include "firmware/haptic/flight_recorder.h"
#include "firmware/haptic/hand_tick.h"
#include "firmware/haptic/stop_input.h"
#include "firmware/haptic/trace.h"
#include "hal/clock.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

inline constexpr Instant kTick = std::chrono::milliseconds(1);
/// Between two looks whether there is a device by now: a thousand a second are work for nothing.
inline constexpr Instant kAbsentTick = 10 * kTick;
inline constexpr Instant kLate = kTick / 2;
/// Zero commands sent after stop: one would do, if no packet were ever lost.
inline constexpr int kClosingTicks = 10;

/// The shell around the law: poll, read, law, command, record. A tick allocates nothing, takes no lock,
/// writes no log and never waits for the fluid. One thread owns the loop and its device; everybody else talks
/// to it through the exchange.
class HapticLoop {
  public:
    /// All of these must outlive the loop. `flights` may be null: then no fault can be run again. `stop_input`, if there is one, is
    /// looked at in every tick: while it is pressed, or nobody has looked at its line lately, that counts as HapticOrders::stop.
    HapticLoop(HapticDevice& device, HapticExchange& exchange, TickTrace& trace,
               const HapticLoopSettings& settings = {}, FlightRecorder* flights = nullptr,
               const StopInput* stop_input = nullptr);

    /// What a tick reads and writes, but for the device's own.
    MemoryPieces memory() const;

    /// One tick. `now` never goes back. For callers that keep time themselves (replay, tests).
    void tick(Instant now);

    /// A tick every kTick (without a device every kAbsentTick) on a fixed grid until `stop`; then kClosingTicks more with the gate shut, and
    /// returns. A tick that comes too late runs once; those whose time passed meanwhile are left out and
    /// counted, never made up for in a burst. After a tick the core is left to others for at least as long as the tick took: on
    /// a machine too slow for 1 kHz a thread of real-time priority would leave nothing to the fluid, nor to whoever logs in.
    void run(Clock& clock, const std::atomic<bool>& stop);

  private:
    Instant pace(Clock& clock, Instant due);

    HapticDevice& device_;
    HapticExchange& exchange_;
    TickTrace& trace_;
    FlightRecorder* flights_;
    const StopInput* stop_input_;
    HandState state_;
    LoopReport report_;
    Instant last_{0};       // time of the last tick
    bool closing_ = false;  // shuts the gate whatever the orders say
};

}  // namespace eddy
