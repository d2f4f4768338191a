#pragma once

namespace eddy::emulated {

/// From 0 to 1 for s in 0..1, starting and ending with zero speed and acceleration: the way people reach
/// (Flash and Hogan 1985, J. Neuroscience 5:1688). Fastest in the middle, 15/8 of the mean; largest
/// acceleration 5.77.
constexpr double minimum_jerk(double s) {
    return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

}  // namespace eddy::emulated
