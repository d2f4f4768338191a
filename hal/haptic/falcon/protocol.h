#pragma once
#include <array>
#include <cstdint>
#include <optional>

namespace eddy::falcon {

// The Falcon's run-time frames: bytes <-> numbers, no I/O. Both directions are 16 bytes, one reply for each
// command (libnifalcon FalconFirmwareNovintSDK.{h,cpp}; from sources, not yet seen on a device):
//
//   byte    0    1-4       5-8       9-12      13                  14   15
//   out    '<'  motor 1   motor 2   motor 3   'A' + lamps, homing  'A'  '>'
//   in     '<'  encoder 1 encoder 2 encoder 3 'A' + homed, buttons  ?   '>'
//
// A value is 16 bits, two's complement, as four bytes 'A' + nibble, least significant nibble first.

inline constexpr std::size_t kFrameBytes = 16;
/// Largest motor value the firmware is known to take (Ouellet's kinematics in libnifalcon's boneyard clamps
/// here).
inline constexpr int kMaxMotor = 4095;

using Frame = std::array<std::uint8_t, kFrameBytes>;
/// One value per motor or encoder, as seen from the front: top, right, left.
using Axes = std::array<int, 3>;

struct Command {
    Axes motors{};  ///< torque in motor units; negative pushes the handle outwards (+z)
    bool homing =
        false;  ///< asks the firmware to look for the index marks, and to keep reporting the homed bits
    bool red = false;
    bool green = false;
    bool blue = false;

    bool operator==(const Command&) const = default;
};

struct Reply {
    Axes encoders{};
    std::array<bool, 3> homed{};
    std::uint8_t buttons =
        0;  ///< bit 0 right, 1 top, 2 centre, 3 left; 1 = pressed (libnifalcon FalconGripFourButton.h)

    bool all_homed() const { return homed[0] && homed[1] && homed[2]; }
    bool operator==(const Reply&) const = default;
};

/// Motor values are clamped to +-kMaxMotor: libnifalcon does not clamp, and its 16 bits would wrap.
Frame encode(const Command& command);
Command decode_command(const Frame& frame);
/// Encoders are cut to 16 bits, as the firmware's counters are.
Frame encode(const Reply& reply);
Reply decode_reply(const Frame& frame);

/// Finds frames in a stream of bytes. A frame is '<', twelve bytes 'A'..'P', one byte 41..C0 hex, any byte,
/// '>'. No byte of a frame but the one at 14 can be '<' or '>', so after a lost byte the next whole frame is
/// found again.
class FrameFinder {
  public:
    /// Takes one byte; gives the frame that it completes.
    std::optional<Frame> push(std::uint8_t byte);
    /// Forgets a frame begun; its bytes count as dropped.
    void clear();
    /// Bytes that belonged to no frame, since construction.
    std::uint64_t dropped() const { return dropped_; }

  private:
    void drop_first();

    Frame bytes_{};
    std::size_t size_ = 0;
    std::uint64_t dropped_ = 0;
};

}  // namespace eddy::falcon
