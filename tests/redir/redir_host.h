#pragma once
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tests/redir/usb_peer.h"

struct usbredirparser;

namespace eddy::redir {

/// The host's side of one usb-redir connection (https://gitlab.freedesktop.org/spice/usbredir, usb-redir-protocol
/// 0.7): shows a device to whoever speaks the guest's side, QEMU or a test. Knows no socket: bytes in, bytes out.
/// While one lives, and the device is plugged in, the device is this guest's. One thread.
class RedirHost {
  public:
    RedirHost(UsbPeer& peer, bool plugged_in);
    /// The plug is pulled, if it was in.
    ~RedirHost();
    RedirHost(const RedirHost&) = delete;
    RedirHost& operator=(const RedirHost&) = delete;

    /// Takes what the guest sent. False: that is no usb-redir; nothing more will be understood, and the connection is to
    /// be closed.
    bool receive(std::span<const std::uint8_t> bytes);
    /// The device's time goes on; what it has ended is answered.
    void poll(Instant now);
    /// What is to be sent to the guest, taken away from here.
    std::vector<std::uint8_t> take_output();

    void unplug();
    void plug_in();

    /// The guest has been shown the device, and has it still.
    bool attached() const { return attached_; }
    /// The guest waits for the device.
    bool busy() const { return !requests_.empty(); }
    /// Why receive() said no; else empty.
    const std::string& complaint() const { return complaint_; }

  private:
    enum class Kind { Control, BulkIn, BulkOut, InterruptOut, InterruptRead };
    struct Request;
    struct Parser;  // what the library calls

    void show_device();
    void submit(std::unique_ptr<Request> request);
    void answer(Request& request, std::uint8_t status);
    void collect();
    /// Ends all requests, and says so.
    void cancel_requests();
    /// The same, in silence.
    void forget_requests();
    void refuse(std::string why);

    UsbPeer& peer_;
    usbredirparser* parser_;
    bool plugged_in_;
    bool greeted_ = false;   // the guest has said hello
    bool attached_ = false;  // it has the device
    bool leaving_ = false;   // it was told that the device has gone, and has not said that it knows
    std::uint8_t configuration_ = 1;
    std::uint64_t interrupts_ = 0;  // packets sent
    std::span<const std::uint8_t> input_;
    std::vector<std::uint8_t> output_;
    std::list<std::unique_ptr<Request>> requests_;
    std::string complaint_;
};

}  // namespace eddy::redir
