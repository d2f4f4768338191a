#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/clock.h"

namespace eddy::falcon {

/// A vendor request on the control pipe without data (wLength 0), in the words of the USB specification,
/// chapter 9.3.
struct ControlRequest {
    std::uint8_t type;     ///< bmRequestType
    std::uint8_t request;  ///< bRequest
    std::uint16_t value;   ///< wValue
    std::uint16_t index;   ///< wIndex

    bool operator==(const ControlRequest&) const = default;
};

/// Full-speed bulk packets hold at most this much (wMaxPacketSize of both endpoints).
inline constexpr std::size_t kPacketBytes = 64;

/// One whole packet from the bulk IN endpoint, with the two status bytes that the FTDI chip puts in front.
struct Packet {
    std::array<std::uint8_t, kPacketBytes> bytes{};
    std::size_t size = 0;
    Instant arrived_at{0};
};

/// What became of the last transfer submitted. Done also before the first one.
enum class Transfer { Done, Pending, Failed };

/// Why there is no device to talk to.
enum class Obstacle {
    NotFound,     ///< no Falcon is plugged in
    OtherSerial,  ///< there is one, but not the one asked for
    Denied,       ///< this user may not open it
    Busy,         ///< another program holds it
    Unusable,     ///< it can be seen but not opened
};

/// The USB device with the FTDI chip, between the driver and what is really there. Nothing blocks: transfers
/// are submitted, and their outcome is asked for at later polls. One transfer in each direction is under way
/// at a time; bulk IN is always asked for in the background. One thread calls everything; nothing allocates.
class Transport {
  public:
    virtual ~Transport() = default;

    /// Takes in what happened until now. Call first in every tick.
    virtual void poll(Instant now) = 0;
    /// True while a Falcon is open and claimed. False once it has gone (NO_DEVICE); the back end looks for it
    /// again.
    virtual bool present() const = 0;
    /// The device's serial string; empty while absent.
    virtual std::string_view serial() const = 0;
    /// While not present: why.
    virtual Obstacle obstacle() const = 0;
    /// Transfers that went wrong since the start; those cut short by unplugging or close() do not count.
    virtual std::uint64_t failures() const = 0;

    /// Only while control() is not Pending.
    virtual void submit_control(const ControlRequest& request) = 0;
    virtual Transfer control() const = 0;

    /// At most kPacketBytes, copied; only while out() is not Pending.
    virtual void submit_out(std::span<const std::uint8_t> bytes) = 0;
    virtual Transfer out() const = 0;

    /// Takes the oldest packet that has come in; false if there is none.
    virtual bool take_in(Packet& packet) = 0;

    /// The last call: sends these bytes after what is under way, waits for them and for nothing else, a tenth
    /// of a second at most, and lets the device go.
    virtual void close(std::span<const std::uint8_t> last_words) = 0;
};

/// How a job of several polls stands.
enum class Progress { Working, Done, Failed };

}  // namespace eddy::falcon
