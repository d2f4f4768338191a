#pragma once
#include "firmware/haptic_study/handle.h"

namespace eddy::haptic_study {

inline constexpr double kCircleM = 0.02;  ///< radius

/// On a circle from half a second on, about the middle of the workspace, so many times a second.
Path circle(double hz);
/// On it once a second until `until`, then to its middle within half a second, rest there, and at `start` off to the right at `speed`.
Path stir_then_go(Seconds until, Seconds start, double speed_m_s);
/// On it once a second until `until`; then the hand wants to be in the middle at once.
Path stir_then_leap(Seconds until);

}  // namespace eddy::haptic_study
