#pragma once

namespace eddy::gles {

/// A speed, or a phi [m/s], that limits nothing, and is a number still when multiplied by a few.
inline constexpr double kNoLimit = 1e30;

}  // namespace eddy::gles
