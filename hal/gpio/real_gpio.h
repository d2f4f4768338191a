#pragma once
#include <filesystem>

#include "hal/gpio/gpio.h"

namespace eddy {

/// The chips whose device files lie in `folder`, through libgpiod: 1.6 or 2.x, whichever this was built with. Opens nothing yet.
std::unique_ptr<Gpio> make_real_gpio(const std::filesystem::path& folder = "/dev");

}  // namespace eddy
