#include "hal/haptic/falcon/firmware_image.h"

#include <fmt/format.h>

namespace eddy::falcon {
namespace {

constexpr std::uint8_t kKey[] = {0xAA, 0x08};
constexpr std::uint64_t kPreambleBytes = 2 + 16 + 4;  // key, reserved words, entry point
constexpr std::uint64_t kBlockHeaderBytes = 2 + 4;    // word count, destination

}  // namespace

BootStream::State BootStream::push(std::uint8_t byte) {
    if (state_ != State::Open) return state_;
    const std::uint64_t at = bytes_++;
    if (at < 2 && byte != kKey[at]) state_ = State::WrongKey;
    if (at + 1 == kPreambleBytes) header_at_ = kPreambleBytes;
    if (at < kPreambleBytes) return state_;

    const std::uint64_t in_block = at - header_at_;
    if (in_block == 0) words_ = byte;
    if (in_block == 1) {
        words_ += std::uint64_t{byte} << 8;
        if (words_ == 0) state_ = State::Complete;
    }
    if (in_block + 1 == kBlockHeaderBytes + 2 * words_) header_at_ = bytes_;
    return state_;
}

std::optional<std::string> problem_in_firmware(std::span<const std::uint8_t> image) {
    BootStream stream;
    for (std::size_t i = 0; i < image.size(); ++i) {
        switch (stream.push(image[i])) {
            case BootStream::State::Open:
                break;
            case BootStream::State::WrongKey:
                return "this is no Falcon firmware: it does not begin with the bytes AA 08";
            case BootStream::State::Complete:
                if (i + 1 == image.size()) return std::nullopt;
                return fmt::format("the firmware ends after {} bytes but the file goes on to {}", i + 1,
                                   image.size());
        }
    }
    return fmt::format("the firmware is cut short: its last block is missing after {} bytes", image.size());
}

}  // namespace eddy::falcon
