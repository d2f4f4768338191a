#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "firmware/haptic/force_gate.h"
#include "hal/clock.h"

namespace eddy {

/// One tick of the loop, for the recorder.
struct TickRecord {
    Instant t{0};
    glm::dvec3 position_m{0.0};    ///< handle, Device frame
    glm::dvec3 velocity_m_s{0.0};  ///< handle, Device frame, low-passed
    glm::dvec3 raw_force_n{0.0};   ///< from the fluid, after gain
    glm::dvec3 filtered_force_n{0.0};
    glm::dvec3 sent_force_n{0.0};      ///< through the gate
    std::uint64_t fluid_sequence = 0;  ///< of the snapshot the force came from
    Instant fluid_age{0};              ///< since that snapshot arrived
    Instant fluid_lag{0};              ///< since the pose that snapshot answers
    GateReason reason = GateReason::Disabled;
    std::uint8_t buttons = 0;
};

/// A queue of ticks from the loop to one reader, of fixed size and without locks. When the reader falls
/// behind, new ticks are dropped and counted; the loop never waits.
class TickTrace {
  public:
    /// Allocates here and never again. `capacity` in ticks, at least 1.
    explicit TickTrace(std::size_t capacity) : ring_(capacity + 1) {}

    /// Loop's thread only.
    void push(const TickRecord& tick);
    /// Reader's thread only: moves the oldest ticks into `out`, as many as fit; returns how many.
    std::size_t drain(std::span<TickRecord> out);

    /// What push() writes.
    std::span<const std::byte> memory() const { return std::as_bytes(std::span(ring_)); }

    std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }  ///< any thread

  private:
    std::size_t after(std::size_t place) const { return place + 1 == ring_.size() ? 0 : place + 1; }

    std::vector<TickRecord> ring_;                 // one place stays empty, to tell full from empty
    alignas(64) std::atomic<std::size_t> in_{0};   // next place to write; moved by the loop alone
    alignas(64) std::atomic<std::size_t> out_{0};  // next place to read; moved by the reader alone
    std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace eddy
