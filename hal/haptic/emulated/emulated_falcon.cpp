#include "hal/haptic/emulated/emulated_falcon.h"

#include <algorithm>
#include <utility>

#include "hal/haptic/falcon/ftdi.h"

namespace eddy::emulated {
namespace {

using namespace std::chrono_literals;
using falcon::FtdiRequest;
using falcon::Packet;
using falcon::Transfer;

constexpr std::size_t kPayload = falcon::kPacketBytes - 2;
constexpr Instant kUsbTime = 60us;       // a small packet at 12 Mb/s with its scheduling
constexpr Instant kControlTime = 125us;  // set-up and status stage
constexpr int kBitsPerByte = 10;         // start, eight data bits, stop
constexpr Instant kNever = Instant::max();

// Status bytes (ftdi_sio.h): nothing special; transmitter empty.
constexpr std::uint8_t kModemStatus = 0x01;
constexpr std::uint8_t kLineStatus = 0x60;
constexpr std::uint8_t kOverrun = 0x02;
constexpr std::uint8_t kFramingError = 0x08;

Instant byte_time(double rate) {
    return std::chrono::duration_cast<Instant>(Seconds(kBitsPerByte / rate));
}

}  // namespace

EmulatedFalcon::EmulatedFalcon(std::unique_ptr<HandMotion> motion, const PlantSettings& plant,
                               const BoardSettings& board)
    : board_(std::move(motion), plant, board) {}

void EmulatedFalcon::poll(Instant now) {
    if (!std::exchange(started_, true)) {
        board_.start(now);
        last_in_ = now;
    }
    if (packet_due(now_)) send_packet(now_);
    // One event after the other, in the order of their times.
    for (;;) {
        const Instant out_at = to_board_.empty() ? kNever : to_board_.front().at;
        const Instant in_at = to_chip_.empty() ? kNever : to_chip_.front().at;
        const Instant timer_at = plugged_in_ && has_room() ? std::max(now_, last_in_ + latency_) : kNever;
        const Instant next = std::min({out_at, in_at, timer_at});
        if (next > now) break;
        now_ = std::max(now_, next);
        if (next == out_at)
            line_to_board();
        else if (next == in_at)
            line_to_chip();
        if (packet_due(now_)) send_packet(now_);
    }
    now_ = std::max(now_, now);
    board_.advance(now_);
}

void EmulatedFalcon::line_to_board() {
    const LineByte arrived = to_board_.pop();
    const EmulatedBoard::Answer answer =
        board_.receive(arrived.at, arrived.byte, arrived.rate * (1.0 + rate_error));
    // The board answers at the rate it was asked at: it understood the question.
    Instant at = std::max(answer.at, line_in_free_);
    for (std::size_t i = 0; i < answer.size; ++i) {
        at += byte_time(arrived.rate);
        to_chip_.push({at, answer.bytes[i], arrived.rate});
    }
    line_in_free_ = at;
}

void EmulatedFalcon::line_to_chip() {
    const LineByte arrived = to_chip_.pop();
    if (line_dead || !plugged_in_ || arrived.rate != rate_) return;
    if (!fifo_.push(arrived.byte)) overrun_ = true;
    if (arrived.byte == event_character_) event_seen_ = true;
}

bool EmulatedFalcon::packet_due(Instant at) const {
    if (!plugged_in_ || !has_room()) return false;
    return fifo_.size() >= kPayload || (splits && !fifo_.empty()) || event_seen_ || at >= last_in_ + latency_;
}

void EmulatedFalcon::send_packet(Instant at) {
    Packet packet;
    packet.bytes[0] = kModemStatus;
    packet.bytes[1] = kLineStatus;
    if (std::exchange(overrun_, false)) packet.bytes[1] |= kOverrun;
    if (line_noisy) packet.bytes[1] |= kFramingError;
    packet.size = 2;
    const std::size_t most = splits ? 3 : falcon::kPacketBytes;
    while (packet.size < most && !fifo_.empty()) packet.bytes[packet.size++] = fifo_.pop();
    packet.arrived_at = at + kUsbTime;
    packets_.push(packet);
    last_in_ = at;
    event_seen_ = false;
}

bool EmulatedFalcon::take_in(Packet& packet) {
    if (packets_.empty() || packets_.front().arrived_at > now_) return false;
    packet = packets_.pop();
    return true;
}

void EmulatedFalcon::submit_control(const falcon::ControlRequest& request) {
    if (request_count_ < requests_.size()) requests_[request_count_++] = {now_, request};
    control_done_ = now_ + kControlTime;
    control_failed_ = stalled || !plugged_in_ || !obey(request);
    failures_ += control_failed_ && plugged_in_ ? 1 : 0;
}

Transfer EmulatedFalcon::control() const {
    if (now_ < control_done_) return Transfer::Pending;
    return control_failed_ ? Transfer::Failed : Transfer::Done;
}

bool EmulatedFalcon::obey(const falcon::ControlRequest& request) {
    if (request.type != falcon::kVendorOut) return false;
    switch (FtdiRequest{request.request}) {
        case FtdiRequest::Reset:
            if (request.value == 0 || request.value == 1) fifo_.clear();
            if (request.value == 0 || request.value == 2) to_board_.clear();
            event_seen_ = false;
            return request.value <= 2;
        case FtdiRequest::ModemControl:
            // High byte: which lines to change, low byte: to what. Bit 0 is DTR.
            if ((request.value & 0x0100) != 0) board_.set_dtr((request.value & 0x0001) != 0, rate_);
            return true;
        case FtdiRequest::BaudRate:
            rate_ = falcon::baud_rate(request);
            return true;
        case FtdiRequest::LatencyTimer:
            if (request.value < 1 || request.value > 255) return false;
            latency_ = std::chrono::milliseconds(request.value);
            return true;
        case FtdiRequest::EventCharacter:
            event_character_.reset();
            if ((request.value & 0x0100) != 0)
                event_character_ = static_cast<std::uint8_t>(request.value & 0xFF);
            return true;
        case FtdiRequest::FlowControl:
        case FtdiRequest::LineFormat:
        case FtdiRequest::ErrorCharacter:
            return true;
    }
    return false;
}

void EmulatedFalcon::submit_out(std::span<const std::uint8_t> bytes) {
    out_done_ = now_ + kUsbTime;
    out_failed_ = stalled || !plugged_in_;
    failures_ += stalled && plugged_in_ ? 1 : 0;
    if (out_failed_) return;
    Instant at = std::max(out_done_, line_out_free_);
    for (const std::uint8_t byte : bytes) {
        at += byte_time(rate_);
        to_board_.push({at, byte, rate_});
    }
    line_out_free_ = at;
}

Transfer EmulatedFalcon::out() const {
    if (now_ < out_done_) return Transfer::Pending;
    return out_failed_ ? Transfer::Failed : Transfer::Done;
}

void EmulatedFalcon::close(std::span<const std::uint8_t> last_words) {
    submit_out(last_words);
}

void EmulatedFalcon::set_room(std::size_t packets) {
    room_ = std::min<std::size_t>(packets, 8);
}

std::uint8_t EmulatedFalcon::latency_ms() const {
    return static_cast<std::uint8_t>(latency_ / 1ms);
}

void EmulatedFalcon::unplug() {
    plugged_in_ = false;
    reset_chip();
}

void EmulatedFalcon::plug_in(bool kept_power) {
    plugged_in_ = true;
    last_in_ = now_;
    if (!kept_power) board_.lose_power();
}

void EmulatedFalcon::reset_chip() {
    rate_ = 9600.0;
    latency_ = 16ms;
    event_character_.reset();
    event_seen_ = false;
    overrun_ = false;
    fifo_.clear();
    packets_.clear();
    to_board_.clear();
    to_chip_.clear();
}

}  // namespace eddy::emulated
