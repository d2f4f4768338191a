#pragma once
#include <cstdio>
#include <functional>
#include <optional>

#include "config/exhibit.h"
#include "firmware/exhibit/lamps.h"
#include "hal/clock.h"
#include "hal/gpio/gpio.h"

namespace eddy {

struct PanelCheck {
    std::optional<LampCode> code{};  ///< show this one in place of one lamp after the other
    double seconds = 10.0;           ///< for so long, or so long to press button and stop
};

/// Says on `out` which lines this machine has, which are the panel's and whether they can be had, lights its lamps, and tells
/// what is pressed. False if a line of the panel's cannot be had. Ends early when `ended` says so.
bool check_panel(Gpio& gpio, const GpioConfig& config, const PanelCheck& check, Clock& clock, std::FILE* out,
                 const std::function<bool()>& ended);

}  // namespace eddy
