#include "tests/fuzz/targets.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "firmware/haptic/flight_file.h"
#include "hal/haptic/falcon/protocol.h"
#include "tests/hal/haptic/synthetic_firmware.h"

// The targets of script/fuzz, with inputs that a seed decides: near to what is valid, as nonsense alone rarely gets far.

namespace eddy {
namespace {

constexpr std::uint64_t kSeed = 20261122;
constexpr int kInputs = 20000;

using Bytes = std::vector<std::uint8_t>;

/// Changes, drops, doubles and inserts a few bytes.
void disturb(Bytes& bytes, std::mt19937_64& random) {
    for (auto times = random() % 6; times > 0 && !bytes.empty(); --times) {
        const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size());
        switch (random() % 4) {
            case 0:
                *at = static_cast<std::uint8_t>(random());
                break;
            case 1:
                bytes.erase(at);
                break;
            case 2:
                bytes.insert(at, *at);
                break;
            default:
                bytes.insert(at, static_cast<std::uint8_t>(0x3C + random() % 8));
        }
    }
}

template <typename Make, typename Target>
void try_many(Make make, Target target) {
    std::mt19937_64 random(kSeed);
    for (int i = 0; i < kInputs; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", input " << i);
        Bytes bytes = make(random);
        disturb(bytes, random);
        target(bytes);
    }
}

Bytes frames(std::mt19937_64& random) {
    Bytes bytes;
    for (auto count = random() % 5; count > 0; --count) {
        const auto value = [&] { return static_cast<int>(random() % 65536) - 32768; };
        const falcon::Frame frame = falcon::encode(falcon::Reply{
            .encoders = {value(), value(), value()}, .buttons = static_cast<std::uint8_t>(random() % 16)});
        bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    return bytes;
}

TEST(Fuzz, FramesAreFoundInAnyBytes) {
    try_many(frames, fuzz_frames);
}

TEST(Fuzz, FirmwareIsJudgedWhateverIsInTheFile) {
    try_many(
        [](std::mt19937_64& random) { return synthetic_firmware(static_cast<std::uint16_t>(random() % 20)); },
        fuzz_firmware);
}

TEST(Fuzz, PacketsOfAnyKindDoNotConfuseTheExchange) {
    try_many(
        [](std::mt19937_64& random) {
            Bytes bytes;
            for (auto packets = random() % 12; packets > 0; --packets) {
                bytes.push_back(static_cast<std::uint8_t>(random() % 8));  // time
                bytes.push_back(static_cast<std::uint8_t>(random()));      // whim
                const Bytes content = frames(random);
                bytes.push_back(static_cast<std::uint8_t>(content.size() + 2));
                bytes.insert(bytes.end(), {0x01, 0x60});
                bytes.insert(bytes.end(), content.begin(), content.end());
            }
            return bytes;
        },
        fuzz_packets);
}

TEST(Fuzz, FlightsAreReadOrRefusedInOneLine) {
    Flight flight;
    flight.version = EDDY_VERSION;
    flight.written = "x";
    flight.ticks.resize(3);
    flight.ticks[1].in.reading = HandleReading{.position_m = {0.01, -0.02, 1e-300}, .buttons = 5};
    flight.ticks[2].in.fluid.force_n = {1.0 / 3.0, -0.0, 1e300};
    std::string text = flight_text(flight);
    const std::size_t state = text.find("\nstate ");
    text.replace(state, text.find('\n', state + 1) + 1 - state, "\nstate!\n");
    std::mt19937_64 random(kSeed);
    for (int i = 0; i < 3000; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", input " << i);
        Bytes bytes(text.begin(), text.end());
        if (i > 0) disturb(bytes, random);
        fuzz_flight(bytes);
    }
}

}  // namespace
}  // namespace eddy
