#pragma once
#include <stdexcept>

#include "hal/gpio/gpio.h"

namespace eddy {

/// A line that cannot be had. what() is one sentence: which, why, and what to do.
class GpioError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct GpioPlace {
    std::string chip_path;
    unsigned offset = 0;
    GpioLineInfo info{};
};

// The address of a line, as it is written in exhibit.toml: its name, as GPIO17; or CHIP:OFFSET, where CHIP is the chip's label,
// name or path, as cp2112_gpio:3.

/// Where that is. Throws GpioError: with the nearest names if there is no such line, with all places if there are several.
GpioPlace find_line(const std::vector<GpioChip>& chips, const std::string& address);

/// Finds and requests it. Throws GpioError.
std::unique_ptr<GpioLine> open_line(Gpio& gpio, const std::string& address, const GpioWish& wish);

}  // namespace eddy
