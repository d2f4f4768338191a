#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace eddy::falcon {

// The firmware is a boot stream of the Falcon's DSP (TMS320F2811): the key AA 08, eight reserved words, the
// entry point (two words), then blocks {word count, destination (two words), words...} up to a block of no
// words. Words come low byte first (TI's boot ROM reference for the C28x; checked against libnifalcon's
// public images). Eddy ships no image: Novint's licence does not allow it.

/// Follows a boot stream byte by byte.
class BootStream {
  public:
    enum class State { Open, Complete, WrongKey };
    /// Bytes after Complete or WrongKey are ignored.
    State push(std::uint8_t byte);
    State state() const { return state_; }

  private:
    State state_ = State::Open;
    std::uint64_t bytes_ = 0;
    std::uint64_t header_at_ = 0;  // where the current block begins
    std::uint64_t words_ = 0;      // its word count
};

/// Why these bytes are no firmware image, as a sentence; nothing if the key is right and the chain of blocks
/// ends with the last byte.
std::optional<std::string> problem_in_firmware(std::span<const std::uint8_t> image);

}  // namespace eddy::falcon
