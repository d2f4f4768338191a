#pragma once
#include <cstdint>
#include <vector>

namespace eddy {

/// A boot stream of one block with this many words of no meaning: all that the emulated Falcon needs, and
/// nobody's property.
inline std::vector<std::uint8_t> synthetic_firmware(std::uint16_t words) {
    std::vector<std::uint8_t> image{0xAA, 0x08};
    image.resize(image.size() + 16);
    const auto word = [&image](unsigned value) {
        image.push_back(static_cast<std::uint8_t>(value & 0xFF));
        image.push_back(static_cast<std::uint8_t>(value >> 8U & 0xFF));
    };
    word(0x003F), word(0x8002);               // entry point, high word first
    word(words), word(0x003F), word(0x8000);  // block: size, destination
    for (unsigned i = 0; i < words; ++i) word(i * 40503U);
    word(0);
    return image;
}

}  // namespace eddy
