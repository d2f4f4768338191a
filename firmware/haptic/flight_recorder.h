#pragma once
#include <array>
#include <atomic>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/haptic/flight.h"
#include "firmware/haptic/realtime.h"

namespace eddy {

/// Keeps the last seconds of the loop in memory, and hands them out after a fault. In the loop it only copies: no allocation, no
/// lock, no system call. It has two stores: one goes to whoever writes it out, in the other it goes on.
class FlightRecorder {
  public:
    /// What is kept: this much at least, and as much again as a segment.
    static constexpr std::size_t kKeptTicks = 5000;
    /// The state of the law is kept once a segment, so the rerun begins at the start of one.
    static constexpr std::size_t kSegmentTicks = 1000;
    /// Ticks that are kept after the fault: what came of it.
    static constexpr std::size_t kAfterTicks = 500;
    /// A fault that comes again is not kept again before this time.
    static constexpr Instant kQuiet = std::chrono::minutes(1);

    /// Allocates here and never again.
    explicit FlightRecorder(const HapticLoopSettings& settings);

    /// What the loop writes.
    MemoryPieces memory() const;

    // Loop's thread only.
    void begin_tick(const HandState& state);
    void end_tick(Instant step, const HapticInput& in, const LawOutput& out);

    /// The flight of a fault that has happened since the last call. One other thread, or any once the loop has ended.
    std::optional<Flight> take();
    /// Once the loop has ended: that of a fault so late that the loop did not see the end of it.
    std::optional<Flight> take_unfinished();
    /// Writes what is in memory of the run so far, as it lies there: for a signal handler, when the program ends badly. The loop may go
    /// on meanwhile; a tick that it is writing may be torn.
    void write_raw(int fd) const noexcept;
    /// What write_raw() wrote, as a flight that ends with the last tick; nothing if it is not whole, or another build wrote it. Its cause is
    /// what the gate said last.
    static std::optional<Flight> read_raw(std::string_view bytes);
    /// Faults that were not kept as the store before was still being read.
    std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

  private:
    struct Segment {
        HandState start{};
        std::size_t count = 0;
        std::vector<FlightTick> ticks = std::vector<FlightTick>(kSegmentTicks);
    };
    struct Store {
        std::array<Segment, kKeptTicks / kSegmentTicks + 1> segments{};
        std::size_t newest = 0;
        GateReason cause = GateReason::Open;
        Instant at{0};
    };
    void watch(const HapticInput& in, const LawOutput& out);
    void hand_over();
    Flight copy(const Store& store) const;

    HapticLoopSettings settings_;
    std::array<Store, 2> stores_;
    std::size_t writing_ = 0;
    std::atomic<const Store*> handed_{nullptr};
    std::atomic<std::uint64_t> lost_{0};
    /// A force has reached the hand since the last fault of each kind.
    std::array<bool, kGateSentences.size()> felt_{};
    bool after_ = false;  ///< a fault has happened, and its end is still being kept
    std::size_t ticks_left_ = 0;
    std::array<std::optional<Instant>, kGateSentences.size()> last_{};  ///< fault of each kind
};

/// Whether somebody will want to know how it came to this: not what visitors do (too fast, released) nor what was ordered.
constexpr bool is_fault(GateReason reason) {
    return reason == GateReason::FluidStale || reason == GateReason::Stopped ||
           reason == GateReason::DeviceNotReady || reason == GateReason::DeviceSilent ||
           reason == GateReason::NotFinite;
}

}  // namespace eddy
