#include "hal/haptic/falcon/protocol.h"

#include <algorithm>

namespace eddy::falcon {
namespace {

constexpr std::uint8_t kBegin = '<';
constexpr std::uint8_t kEnd = '>';
constexpr std::uint8_t kZero = 'A';  // every number is written as an offset from this letter
constexpr std::size_t kValueBytes = 4;
constexpr std::size_t kFlags = 13;

// Command flags, from the code of libnifalcon FalconFirmwareNovintSDK.cpp; the comments of its header name
// other bits for the lamps, and its users confirm the code.
constexpr int kHoming = 0x01;
constexpr int kGreen = 0x02;
constexpr int kBlue = 0x04;
constexpr int kRed = 0x08;

// Reply flags: buttons in the low four bits, then one homed bit for each axis (same source).
constexpr int kButtons = 0x0F;
constexpr int kHomedTop = 0x10;
constexpr int kAllFlags = 0x7F;

std::uint8_t letter(int offset) {
    return static_cast<std::uint8_t>(kZero + offset);
}

void put_value(Frame& frame, std::size_t axis, int value) {
    const auto bits = static_cast<std::uint16_t>(value);
    for (std::size_t n = 0; n < kValueBytes; ++n)
        frame[1 + kValueBytes * axis + n] = letter((bits >> (4 * n)) & 0xF);
}

int get_value(const Frame& frame, std::size_t axis) {
    unsigned bits = 0;
    for (std::size_t n = 0; n < kValueBytes; ++n)
        bits |= ((frame[1 + kValueBytes * axis + n] - unsigned{kZero}) & 0xFU) << (4 * n);
    return static_cast<std::int16_t>(bits);
}

Frame framed(const Axes& values, int flags) {
    Frame frame{};
    frame.front() = kBegin;
    for (std::size_t axis = 0; axis < values.size(); ++axis) put_value(frame, axis, values[axis]);
    frame[kFlags] = letter(flags);
    frame[kFlags + 1] = kZero;  // meaning unknown; always 'A' in every source
    frame.back() = kEnd;
    return frame;
}

Axes values_of(const Frame& frame) {
    return {get_value(frame, 0), get_value(frame, 1), get_value(frame, 2)};
}

bool allowed(std::size_t position, std::uint8_t byte) {
    if (position == 0) return byte == kBegin;
    if (position < kFlags) return byte >= kZero && byte <= kZero + 0xF;
    if (position == kFlags) return byte >= kZero && byte <= kZero + kAllFlags;
    return position == kFlags + 1 || byte == kEnd;
}

}  // namespace

Frame encode(const Command& command) {
    Axes motors = command.motors;
    for (int& motor : motors) motor = std::clamp(motor, -kMaxMotor, kMaxMotor);
    return framed(motors, (command.homing ? kHoming : 0) | (command.green ? kGreen : 0) |
                              (command.blue ? kBlue : 0) | (command.red ? kRed : 0));
}

Command decode_command(const Frame& frame) {
    const int flags = frame[kFlags] - kZero;
    return {.motors = values_of(frame),
            .homing = (flags & kHoming) != 0,
            .red = (flags & kRed) != 0,
            .green = (flags & kGreen) != 0,
            .blue = (flags & kBlue) != 0};
}

Frame encode(const Reply& reply) {
    int flags = reply.buttons & kButtons;
    for (std::size_t axis = 0; axis < reply.homed.size(); ++axis)
        if (reply.homed[axis]) flags |= kHomedTop << axis;
    return framed(reply.encoders, flags);
}

Reply decode_reply(const Frame& frame) {
    const int flags = frame[kFlags] - kZero;
    return {.encoders = values_of(frame),
            .homed = {(flags & kHomedTop) != 0, (flags & kHomedTop << 1) != 0, (flags & kHomedTop << 2) != 0},
            .buttons = static_cast<std::uint8_t>(flags & kButtons)};
}

std::optional<Frame> FrameFinder::push(std::uint8_t byte) {
    bytes_[size_++] = byte;
    const auto possible = [this] {
        for (std::size_t i = 0; i < size_; ++i)
            if (!allowed(i, bytes_[i])) return false;
        return true;
    };
    while (!possible()) drop_first();
    if (size_ < kFrameBytes) return std::nullopt;
    size_ = 0;
    return bytes_;
}

void FrameFinder::clear() {
    dropped_ += size_;
    size_ = 0;
}

void FrameFinder::drop_first() {
    std::copy(bytes_.begin() + 1, bytes_.end(), bytes_.begin());
    --size_;
    ++dropped_;
}

}  // namespace eddy::falcon
