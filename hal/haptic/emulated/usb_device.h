#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/haptic/emulated/emulated_falcon.h"

namespace eddy::emulated {

/// What a device says of itself.
struct UsbIdentity {
    std::uint16_t product = 0xCB48;  ///< 0x6001 is a plain FT232R
    std::string product_name = "FALCON HAPTIC";
    std::string serial = "EMUL0001";
};

/// A request as an operating system hands it to a host controller.
struct Urb {
    enum class Pipe { Control, In, Out };
    enum class Status { Pending, Done, Stalled, Overflowed, Garbled, Cancelled, Gone };

    const void* id = nullptr;  ///< the host's name for it
    Pipe pipe = Pipe::Control;
    std::span<std::uint8_t> buffer{};  ///< the host's memory; control: eight bytes of set-up, then the data
    std::size_t actual = 0;            ///< bytes that were moved, without the set-up
    Status status = Status::Pending;
};

/// The emulated Falcon as a USB device: descriptors, standard and vendor requests, and queues of requests that are
/// completed when the device has something to say. Whoever carries these requests (a file system below libusb, a
/// network) adds no behaviour of its own. Virtual time, moved by poll().
class UsbDevice {
  public:
    UsbDevice(std::unique_ptr<EmulatedFalcon> falcon, UsbIdentity identity);

    /// Device descriptor, then the configuration with its interface and endpoints: those of a stock FT232R, whose
    /// lsusb output is public; the Falcon's own may differ in its power needs.
    std::span<const std::uint8_t> descriptors() const { return descriptors_; }

    void poll(Instant now);
    /// The id must be new among those under way.
    void submit(const Urb& urb);
    /// Ends a request early; it is reaped like the others. False if it is not under way.
    bool cancel(const void* id);
    /// The request that ended first; nothing if none waits.
    std::optional<Urb> reap();
    bool has_ended() const { return !ended_.empty(); }

    /// Everything under way ends as Gone, and nothing more is taken until plug_in().
    void unplug();
    void plug_in(bool kept_power);

    /// From now on this endpoint answers STALL, as it does too once the chip has refused it a transfer, until its halt is cleared
    /// (USB 2.0, 9.4.5); the other is none the worse.
    void halt(Urb::Pipe endpoint) { (endpoint == Urb::Pipe::In ? in_halted_ : out_halted_) = true; }
    /// CLEAR_FEATURE(ENDPOINT_HALT) of the endpoint with this address; false: the device refuses it.
    bool clear_halt(std::uint8_t endpoint);

    bool garbled = false;  ///< a bad cable: every request ends in error at once
    bool hung = false;     ///< the device accepts nothing and says nothing: no request ends

    EmulatedFalcon& falcon() { return *falcon_; }
    const UsbIdentity& identity() const { return identity_; }

  private:
    void end(std::deque<Urb>& queue, Urb::Status status);
    void end_all(Urb::Status status);
    void serve_control(Instant now);
    void begin_control(Urb& urb, Instant now);
    void serve_out();
    void serve_in();
    /// What the device answers to an IN request; nothing: it stalls.
    std::optional<std::vector<std::uint8_t>> answer(const falcon::ControlRequest& request);

    std::unique_ptr<EmulatedFalcon> falcon_;
    UsbIdentity identity_;
    std::vector<std::uint8_t> descriptors_;
    std::deque<Urb> control_, in_, out_, ended_;
    bool plugged_in_ = true;
    bool in_halted_ = false, out_halted_ = false;

    // The control request at the head of its queue.
    bool control_begun_ = false;
    bool by_chip_ = false;                             // a vendor request: the chip says when it is done
    Instant answered_at_{0};                           // else: when the answer is there,
    std::optional<std::vector<std::uint8_t>> answer_;  // and what it is
    bool out_begun_ = false;
};

}  // namespace eddy::emulated
