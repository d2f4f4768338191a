#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "hal/haptic/emulated/usb_device.h"

namespace eddy::redir {

using emulated::Urb;

/// A USB device that a guest may be given: what UsbDevice (hal/haptic/emulated/usb_device.h) is to a host. One thread.
class UsbPeer {
  public:
    virtual ~UsbPeer() = default;

    /// The device descriptor, then its only configuration with all that belongs to it.
    virtual std::span<const std::uint8_t> descriptors() const = 0;

    /// Its time goes on to `now`, plugged in or not.
    virtual void poll(Instant now) = 0;
    /// The buffer and the id are the host's, and stay until the request is reaped.
    virtual void submit(const Urb& urb) = 0;
    virtual bool cancel(const void* id) = 0;
    virtual std::optional<Urb> reap() = 0;

    /// The bus takes its power away, and whatever was under way ends; gives it back; or only says that the device is to
    /// begin anew.
    virtual void unplug() = 0;
    virtual void plug_in() = 0;
    virtual void reset() = 0;
};

}  // namespace eddy::redir
