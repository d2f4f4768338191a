#pragma once
#include "firmware/haptic/exchange.h"

namespace eddy {

// Where the body stops at the bounds of the tank, the handle feels a soft wall. A sampled wall of stiffness K and damping B does not
// drive a handle whose own damping is b if b > K (T/2 + d) + B (Colgate and Schenkel 1997, with a delay d): at T = 1 ms
// and d = 2 ms, a tick and the device's exchange, these take 0.3 + 0.2 of 0.5 N s/m. A Falcon's own damping was measured at 2.8.
inline constexpr double kWallStiffnessNM = 120.0;
inline constexpr double kWallDampingNsM = 0.2;

/// Force on the handle [N] from the bounds of its body. `position_m`, `velocity_m_s`: of the handle, Device frame.
inline glm::dvec3 soft_wall_n(const HapticOrders& orders, const glm::dvec3& position_m,
                              const glm::dvec3& velocity_m_s) {
    const glm::dvec3 wanted = orders.tank_from_device.position(position_m);
    const glm::dvec3 inside = glm::min(glm::max(wanted, orders.lowest_m), orders.highest_m);
    const glm::dvec3 depth_m = (wanted - inside) / orders.tank_from_device.scale;
    glm::dvec3 force_n = -kWallStiffnessNM * depth_m;
    // The damper works on the way in only: it does not hold a handle back that comes out.
    for (int axis = 0; axis < 3; ++axis)
        if (depth_m[axis] * velocity_m_s[axis] > 0.0) force_n[axis] -= kWallDampingNsM * velocity_m_s[axis];
    return force_n;
}

}  // namespace eddy
