#pragma once
#include <cstdint>
#include <span>

namespace eddy {

// What must hold for every input, whoever chooses it: chance in tests/fuzz/targets_test.cpp, libFuzzer in
// script/fuzz. Each ends the program if it does not.

/// Bytes from the line: each frame found is one, writes back as it was read, and no byte is counted twice or lost.
void fuzz_frames(std::span<const std::uint8_t> input);
/// A firmware file: accepted only if its chain of blocks ends with its last byte.
void fuzz_firmware(std::span<const std::uint8_t> input);
/// Packets of any size and content at any time: the exchange keeps to one command at a time and never waits for ever.
void fuzz_packets(std::span<const std::uint8_t> input);

/// A flight recording: taken, run again, and then written as it was read, or refused in one line. A line "state!" stands for a state, and the sum is made right.
void fuzz_flight(std::span<const std::uint8_t> input);

}  // namespace eddy
