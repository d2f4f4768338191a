#pragma once
#include <cstdint>
#include <span>

namespace eddy {

// Like targets.h, of what people write.

/// Settings in layers, parted by lines "%%": exhibit.toml first, then those of conf.d. Taken, and then printed to what reads back
/// the same, with a ceiling that no file of conf.d raised; or refused with places inside them.
void fuzz_exhibit(std::span<const std::uint8_t> input);

/// A scene: taken, and then printed to what reads back the same; or refused with places inside it.
void fuzz_scene(std::span<const std::uint8_t> input);

}  // namespace eddy
