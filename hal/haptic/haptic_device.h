#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "hal/clock.h"

namespace eddy {

/// One position of the handle, as the device reported it.
struct HandleReading {
    glm::dvec3 position_m{0.0};  ///< Device frame (hal/frames.h)
    std::uint8_t buttons = 0;    ///< bit 0 right, 1 top, 2 centre, 3 left; 1 = pressed; debounced
    Instant taken_at{0};         ///< when the last byte of the reply arrived
};

/// The light in the handle's ring.
struct HandleLight {
    bool red = false, green = false, blue = false;
    bool operator==(const HandleLight&) const = default;
};

/// Absent: not found. Booting: found, answering no frames yet. Loading: firmware upload. Homing: running,
/// positions not yet absolute. Ready: positions are true and forces are obeyed. Fault: given up until the
/// device comes back.
enum class HapticState { Absent, Booting, Loading, Homing, Ready, Fault };
const char* to_string(HapticState state);

/// What went wrong since start, one counter for each kind of trouble. Never reset while running.
struct HapticCounters {
    std::uint64_t exchanges = 0;     ///< good replies
    std::uint64_t timeouts = 0;      ///< no reply in time
    std::uint64_t bad_bytes = 0;     ///< bytes dropped to find the frame again
    std::uint64_t implausible = 0;   ///< encoder jumps faster than a hand
    std::uint64_t unsolved = 0;      ///< poses the forward kinematics could not reach
    std::uint64_t saturated = 0;     ///< commands scaled down to the motors' range
    std::uint64_t rehomed = 0;       ///< times the homed bits were lost
    std::uint64_t lost = 0;          ///< times the device went away
    std::uint64_t line_faults = 0;   ///< packets whose status names an overrun, parity, framing or FIFO error
    std::uint64_t usb_errors = 0;    ///< USB transfers that failed though the device was there
    std::uint64_t failed_boots = 0;  ///< tries to start it that missed a deadline or were refused,
    std::uint64_t wrong_echoes = 0;  ///< of these: a byte of the firmware came back changed
    std::uint64_t given_up = 0;      ///< times it went to Fault
};

/// The haptic device as the 1 kHz loop sees it. One thread calls everything; no call blocks, allocates or
/// logs. Real: falcon/. Emulated: emulated/ (the same driver above an emulated device, byte by byte).
class HapticDevice {
  public:
    virtual ~HapticDevice() = default;

    /// Moves the driver on: takes in what arrived, runs the state machine and its deadlines. Call once per
    /// tick, first.
    virtual void poll(Instant now) = 0;
    /// The newest reading not yet handed out; nothing if none arrived since the last call or the state is not
    /// Ready.
    virtual std::optional<HandleReading> read() = 0;
    /// Sends a force [N, Device frame] to the visitor's hand, in this tick. Only Ready obeys; in every other state zero is
    /// sent. A force that is not finite counts as zero. While the last command is unanswered nothing is sent: the next
    /// tick's force is newer than this one would be by then. If nobody commands it for some polls, it is sent zero.
    virtual void command(const glm::dvec3& force_n) = 0;
    /// Whether a command of this tick is obeyed, if one can be sent. While Ready it may be that it is not for a moment: it is not sure
    /// where the handle is, and sends zero.
    virtual bool obeys() const { return state() == HapticState::Ready; }
    /// From the next command on, while Ready, the light is this; until it is said for the first time, green. In other states it
    /// says what the device needs: red while it wants to be homed.
    virtual void show(const HandleLight& light) = 0;

    virtual HapticState state() const = 0;
    virtual HapticCounters counters() const = 0;
    /// Seconds since the last good reply; infinite before the first.
    virtual Seconds silence(Instant now) const = 0;
    /// For the log: model, serial, what it is waiting for.
    virtual std::string describe() const = 0;
};

}  // namespace eddy
