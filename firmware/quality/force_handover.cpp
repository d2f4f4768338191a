#include "firmware/quality/force_handover.h"

#include <algorithm>
#include <cmath>

namespace eddy {

namespace {

/// Of a fluid anything is believed that it says of itself; what the hand can bear is another's business.
constexpr SlopeBounds kAny{.drag_ns_m = 1e6, .added_kg = 1e6};
constexpr Seconds kTakenAtOnce = 100.0 * LocalModel::kFollow;

}  // namespace

gles::Load ForceHandover::hand_on(const gles::Load& load, const Motion& motion, Seconds time) {
    if (!std::isfinite(glm::length(load.force_n) + glm::length(load.torque_nm)))
        return load;  // the gate's business
    const gles::Load as_before{last_.force_n + of_motion_n(motion) - of_motion_n(motion_), last_.torque_nm};
    if (settling_ > 1) {
        --settling_;
        return as_before;
    }
    if (settling_ == 1) {
        difference_ = {as_before.force_n - load.force_n, as_before.torque_nm - load.torque_nm};
        began_ = time;
        settling_ = 0;
    }
    model_.learn({load.force_n, motion.velocity_m_s, motion.acceleration_m_s2}, time - time_, kAny);
    model_.follow(kTakenAtOnce, kAny);
    const double s = std::clamp((time - began_) / kFade, 0.0, 1.0);
    const double rest = 1.0 - s * s * (3.0 - 2.0 * s);
    last_ = {load.force_n + rest * difference_.force_n, load.torque_nm + rest * difference_.torque_nm};
    motion_ = motion;
    time_ = time;
    any_ = true;
    return last_;
}

}  // namespace eddy
