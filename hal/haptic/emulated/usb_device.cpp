#include "hal/haptic/emulated/usb_device.h"

#include <algorithm>
#include <utility>

#include "hal/haptic/falcon/ftdi.h"
#include "hal/haptic/falcon/usb_link.h"

namespace eddy::emulated {
namespace {

using namespace std::chrono_literals;
using falcon::Transfer;

constexpr std::size_t kSetupBytes = 8;
constexpr std::uint8_t kPacket = falcon::kPacketBytes;
constexpr Instant kControlTime = 125us;  // set-up, data and status stage

// USB 2.0 specification, chapter 9.
constexpr std::uint8_t kInEndpoint = 0x81, kOutEndpoint = 0x02;
constexpr std::uint16_t kEndpointHalt = 0;
constexpr std::uint8_t kStandardIn = 0x80, kEndpointOut = 0x02, kVendorIn = 0xC0;
constexpr std::uint8_t kClearFeature = 1, kGetStatus = 0, kGetDescriptor = 6, kGetConfiguration = 8,
                       kSetConfiguration = 9;
constexpr std::uint8_t kDeviceType = 1, kConfigurationType = 2, kStringType = 3;
constexpr std::size_t kDeviceBytes = 18;
// FTDI's own requests that answer (ftdi_sio.h).
constexpr std::uint8_t kGetModemStatus = 5, kGetLatency = 10;

constexpr std::uint8_t low(std::uint16_t word) {
    return static_cast<std::uint8_t>(word & 0xFF);
}
constexpr std::uint8_t high(std::uint16_t word) {
    return static_cast<std::uint8_t>(word >> 8);
}

std::vector<std::uint8_t> descriptors_of(std::uint16_t product) {
    return {// device: USB 2.0, release 6.00; strings 1 to 3; one configuration
            18, kDeviceType, 0x00, 0x02, 0, 0, 0, 8, low(falcon::kVendor), high(falcon::kVendor),
            low(product), high(product), 0x00, 0x06, 1, 2, 3, 1,
            // configuration: bus powered, remote wake-up, 90 mA
            9, kConfigurationType, 32, 0, 1, 1, 0, 0xA0, 45,
            // interface 0, vendor's own class
            9, 4, 0, 0, 2, 0xFF, 0xFF, 0xFF, 2,
            // bulk endpoints 81 and 02
            7, 5, kInEndpoint, 2, kPacket, 0, 0, 7, 5, kOutEndpoint, 2, kPacket, 0, 0};
}

std::vector<std::uint8_t> string_descriptor(const std::string& text) {
    std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(2 + 2 * text.size()), kStringType};
    for (const char letter : text) {
        bytes.push_back(static_cast<std::uint8_t>(letter));
        bytes.push_back(0);
    }
    return bytes;
}

}  // namespace

UsbDevice::UsbDevice(std::unique_ptr<EmulatedFalcon> falcon, UsbIdentity identity)
    : falcon_(std::move(falcon)),
      identity_(std::move(identity)),
      descriptors_(descriptors_of(identity_.product)) {}

void UsbDevice::poll(Instant now) {
    std::size_t room = 0;
    for (const Urb& urb : in_) room += (urb.buffer.size() - urb.actual + kPacket - 1) / kPacket;
    falcon_->set_room(room);
    falcon_->poll(now);
    if (!plugged_in_ || hung) return;
    if (garbled) return end_all(Urb::Status::Garbled);
    serve_control(now);
    serve_out();
    serve_in();
}

void UsbDevice::submit(const Urb& urb) {
    if (!plugged_in_) {
        ended_.push_back(urb);
        ended_.back().status = Urb::Status::Gone;
        return;
    }
    (urb.pipe == Urb::Pipe::Control ? control_ : urb.pipe == Urb::Pipe::In ? in_ : out_).push_back(urb);
}

bool UsbDevice::cancel(const void* id) {
    for (auto* queue : {&control_, &in_, &out_}) {
        const auto urb =
            std::find_if(queue->begin(), queue->end(), [id](const Urb& u) { return u.id == id; });
        if (urb == queue->end()) continue;
        if (queue == &control_ && urb == queue->begin()) control_begun_ = false;
        if (queue == &out_ && urb == queue->begin()) out_begun_ = false;
        ended_.push_back(*urb);
        ended_.back().status = Urb::Status::Cancelled;
        queue->erase(urb);
        return true;
    }
    return false;
}

std::optional<Urb> UsbDevice::reap() {
    if (ended_.empty()) return std::nullopt;
    const Urb urb = ended_.front();
    ended_.pop_front();
    return urb;
}

void UsbDevice::unplug() {
    plugged_in_ = false;
    falcon_->unplug();
    end_all(Urb::Status::Gone);
}

void UsbDevice::plug_in(bool kept_power) {
    plugged_in_ = true;
    in_halted_ = out_halted_ = false;
    falcon_->plug_in(kept_power);
}

void UsbDevice::end_all(Urb::Status status) {
    control_begun_ = out_begun_ = false;
    for (auto* queue : {&control_, &in_, &out_})
        while (!queue->empty()) end(*queue, status);
}

void UsbDevice::end(std::deque<Urb>& queue, Urb::Status status) {
    ended_.push_back(queue.front());
    ended_.back().status = status;
    queue.pop_front();
}

void UsbDevice::serve_control(Instant now) {
    if (control_.empty()) return;
    Urb& urb = control_.front();
    if (!std::exchange(control_begun_, true)) begin_control(urb, now);
    if (by_chip_) {
        const Transfer done = falcon_->control();
        if (done == Transfer::Pending) return;
        control_begun_ = false;
        return end(control_, done == Transfer::Done ? Urb::Status::Done : Urb::Status::Stalled);
    }
    if (now < answered_at_) return;
    control_begun_ = false;
    if (!answer_) return end(control_, Urb::Status::Stalled);
    const auto data = urb.buffer.subspan(kSetupBytes);
    urb.actual = std::min(answer_->size(), data.size());
    std::copy_n(answer_->begin(), urb.actual, data.begin());
    end(control_, Urb::Status::Done);
}

void UsbDevice::begin_control(Urb& urb, Instant now) {
    const auto word = [&urb](std::size_t at) {
        return static_cast<std::uint16_t>(urb.buffer[at] | urb.buffer[at + 1] << 8);
    };
    const falcon::ControlRequest request{urb.buffer[0], urb.buffer[1], word(2), word(4)};
    by_chip_ = request.type == falcon::kVendorOut;
    if (by_chip_) return falcon_->submit_control(request);
    answered_at_ = now + kControlTime;
    answer_ = answer(request);
}

bool UsbDevice::clear_halt(std::uint8_t endpoint) {
    if (falcon_->stalled || (endpoint != kInEndpoint && endpoint != kOutEndpoint)) return false;
    (endpoint == kInEndpoint ? in_halted_ : out_halted_) = false;
    return true;
}

std::optional<std::vector<std::uint8_t>> UsbDevice::answer(const falcon::ControlRequest& asked) {
    const auto [type, request, value, index] = asked;
    if (type == kVendorIn && request == kGetModemStatus) return std::vector<std::uint8_t>{0x01, 0x60};
    if (type == kVendorIn && request == kGetLatency) return std::vector<std::uint8_t>{falcon_->latency_ms()};
    if (type == kEndpointOut && request == kClearFeature && value == kEndpointHalt && clear_halt(low(index)))
        return std::vector<std::uint8_t>{};
    if (type == 0 && request == kSetConfiguration) {
        in_halted_ = out_halted_ = false;
        return std::vector<std::uint8_t>{};
    }
    if (type != kStandardIn) return std::nullopt;
    if (request == kGetStatus) return std::vector<std::uint8_t>{0, 0};
    if (request == kGetConfiguration) return std::vector<std::uint8_t>{1};
    if (request != kGetDescriptor) return std::nullopt;
    const auto split = descriptors_.begin() + kDeviceBytes;
    switch (high(value)) {
        case kDeviceType:
            return std::vector<std::uint8_t>(descriptors_.begin(), split);
        case kConfigurationType:
            return std::vector<std::uint8_t>(split, descriptors_.end());
        case kStringType:
            switch (low(value)) {
                case 0:
                    return std::vector<std::uint8_t>{4, kStringType, 0x09, 0x04};  // US English
                case 1:
                    return string_descriptor("FTDI");
                case 2:
                    return string_descriptor(identity_.product_name);
                case 3:
                    return string_descriptor(identity_.serial);
                default:
                    return std::nullopt;
            }
        default:
            return std::nullopt;
    }
}

void UsbDevice::serve_out() {
    while (!out_.empty()) {
        Urb& urb = out_.front();
        if (!out_begun_ && out_halted_) {
            end(out_, Urb::Status::Stalled);
            continue;
        }
        if (!std::exchange(out_begun_, true)) falcon_->submit_out(urb.buffer);
        const Transfer done = falcon_->out();
        if (done == Transfer::Pending) return;
        out_begun_ = false;
        if (done == Transfer::Done)
            urb.actual = urb.buffer.size();
        else
            halt(Urb::Pipe::Out);
        end(out_, done == Transfer::Done ? Urb::Status::Done : Urb::Status::Stalled);
    }
}

void UsbDevice::serve_in() {
    if (falcon_->stalled) halt(Urb::Pipe::In);
    while (in_halted_ && !in_.empty()) end(in_, Urb::Status::Stalled);
    falcon::Packet packet;
    while (!in_.empty() && falcon_->take_in(packet)) {
        Urb& urb = in_.front();
        const std::size_t size = std::min(packet.size, urb.buffer.size() - urb.actual);
        std::copy_n(packet.bytes.begin(), size, urb.buffer.begin() + static_cast<std::ptrdiff_t>(urb.actual));
        urb.actual += size;
        // A packet that is not full ends a transfer, and so does a full buffer.
        if (size < packet.size)
            end(in_, Urb::Status::Overflowed);
        else if (packet.size < kPacket || urb.buffer.size() - urb.actual == 0)
            end(in_, Urb::Status::Done);
    }
}

}  // namespace eddy::emulated
