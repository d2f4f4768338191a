#pragma once
#include <numbers>

#include "firmware/haptic/exponential.h"
#include "hal/clock.h"

namespace eddy {

/// Weight w of the new sample in y += w (x - y), the first-order low-pass dy/dt = 2 pi f (x - y) solved
/// exactly for an x held over dt. Exact for any dt, so late and missed ticks change nothing but the sampling:
/// two half steps are one step.
inline double low_pass_weight(double cutoff_hz, Seconds dt) {
    return dt.count() > 0.0 ? gone_of(2.0 * std::numbers::pi * cutoff_hz * dt.count()) : 0.0;
}

}  // namespace eddy
