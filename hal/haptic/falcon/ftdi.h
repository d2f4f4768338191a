#pragma once
#include <cstdint>
#include <span>

#include "hal/haptic/falcon/transport.h"

namespace eddy::falcon {

// The FTDI FT232R between USB and the Falcon's serial line. Request words: Linux
// drivers/usb/serial/ftdi_sio.h; the values that the Falcon needs: libnifalcon FalconCommLibUSB.cpp. wIndex 0
// stands for the chip's only port.

/// bmRequestType: vendor request to the device, host to device.
inline constexpr std::uint8_t kVendorOut = 0x40;

/// bRequest.
enum class FtdiRequest : std::uint8_t {
    Reset = 0,
    ModemControl = 1,
    FlowControl = 2,
    BaudRate = 3,
    LineFormat = 4,
    EventCharacter = 6,
    ErrorCharacter = 7,
    LatencyTimer = 9,
};

constexpr ControlRequest ftdi_request(FtdiRequest request, std::uint16_t value, std::uint16_t index = 0) {
    return {kVendorOut, static_cast<std::uint8_t>(request), value, index};
}

constexpr ControlRequest purge_receiver() {
    return ftdi_request(FtdiRequest::Reset, 1);
}
constexpr ControlRequest purge_transmitter() {
    return ftdi_request(FtdiRequest::Reset, 2);
}
constexpr ControlRequest set_dtr(bool high) {
    return ftdi_request(FtdiRequest::ModemControl, high ? 0x0101 : 0x0100);
}
constexpr ControlRequest set_rts(bool high) {
    return ftdi_request(FtdiRequest::ModemControl, high ? 0x0202 : 0x0200);
}
constexpr ControlRequest no_flow_control() {
    return ftdi_request(FtdiRequest::FlowControl, 0);
}
constexpr ControlRequest eight_bits_no_parity_one_stop() {
    return ftdi_request(FtdiRequest::LineFormat, 8);
}
/// The chip sends a short packet after this many milliseconds even if it has nothing to say, 1..255.
constexpr ControlRequest set_latency(std::uint8_t ms) {
    return ftdi_request(FtdiRequest::LatencyTimer, ms);
}
/// The chip sends what it has as soon as this byte arrives.
constexpr ControlRequest flush_on(char character) {
    return ftdi_request(FtdiRequest::EventCharacter,
                        static_cast<std::uint16_t>(0x0100 | static_cast<std::uint8_t>(character)));
}

// The Falcon's three rates, as divisor words of 3 MBd.
constexpr ControlRequest baud_9600() {
    return ftdi_request(FtdiRequest::BaudRate, 0x4138);
}  ///< PIC, /312.5
constexpr ControlRequest baud_142857() {
    return ftdi_request(FtdiRequest::BaudRate, 0x0015);
}  ///< upload, /21
constexpr ControlRequest baud_1500000() {
    return ftdi_request(FtdiRequest::BaudRate, 0x0002);
}  ///< run time, /2

/// The rate [Bd] that a BaudRate request sets.
double baud_rate(const ControlRequest& request);

/// What a packet carries behind its two status bytes. The chip puts them in front of every packet of up to 64
/// bytes, so they are stripped packet by packet; a packet of two bytes says only that nothing arrived.
struct Payload {
    std::span<const std::uint8_t> bytes;
    bool line_fault = false;  ///< overrun, parity, framing or FIFO error since the last packet
};
/// The payload points into the packet.
Payload strip_status(const Packet& packet);

/// Issues a list of control requests one after the other, in order.
class RequestList {
  public:
    /// The list must outlive the work.
    void start(std::span<const ControlRequest> requests);
    /// Submits the next request if the last one is done. Failed if the device refused one.
    Progress poll(Transport& transport);

  private:
    std::span<const ControlRequest> rest_;
    bool submitted_ = false;
};

}  // namespace eddy::falcon
