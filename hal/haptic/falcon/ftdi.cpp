#include "hal/haptic/falcon/ftdi.h"

#include <algorithm>
#include <array>

namespace eddy::falcon {
namespace {

constexpr double kBaseRate = 3e6;  // [Bd]
// Eighths by their three-bit code (ftdi_sio.h: the codes are not in order).
constexpr std::array<double, 8> kFraction{0.0, 0.5, 0.25, 0.125, 0.375, 0.625, 0.75, 0.875};
constexpr std::uint8_t kLineFaults = 0x8E;  // status byte 1: FIFO error, framing, parity, overrun

}  // namespace

double baud_rate(const ControlRequest& request) {
    const unsigned whole = request.value & 0x3FFFU;
    const unsigned code = (request.value >> 14U) | (request.index & 1U) << 2U;
    if (whole == 0 && code == 0) return kBaseRate;
    if (whole == 1 && code == 0) return kBaseRate / 1.5;
    return kBaseRate / (whole + kFraction[code]);
}

Payload strip_status(const Packet& packet) {
    if (packet.size < 2) return {};
    const std::size_t size = std::min(packet.size, kPacketBytes);
    return {std::span(packet.bytes).subspan(2, size - 2), (packet.bytes[1] & kLineFaults) != 0};
}

void RequestList::start(std::span<const ControlRequest> requests) {
    rest_ = requests;
    submitted_ = false;
}

Progress RequestList::poll(Transport& transport) {
    const Transfer last = transport.control();
    if (last == Transfer::Pending) return Progress::Working;
    if (submitted_ && last == Transfer::Failed) return Progress::Failed;
    if (rest_.empty()) return Progress::Done;
    transport.submit_control(rest_.front());
    rest_ = rest_.subspan(1);
    submitted_ = true;
    return Progress::Working;
}

}  // namespace eddy::falcon
