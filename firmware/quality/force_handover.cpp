#include "firmware/quality/force_handover.h"

#include <algorithm>
#include <cmath>

namespace eddy {

gles::Load ForceHandover::hand_on(const gles::Load& load, Seconds time) {
    if (!std::isfinite(glm::length(load.force_n) + glm::length(load.torque_nm)))
        return load;  // the gate's business
    if (settling_ > 1) {
        --settling_;
        return last_;
    }
    if (settling_ == 1) {
        difference_ = {last_.force_n - load.force_n, last_.torque_nm - load.torque_nm};
        began_ = time;
        settling_ = 0;
    }
    const double s = std::clamp((time - began_) / kFade, 0.0, 1.0);
    const double rest = 1.0 - s * s * (3.0 - 2.0 * s);
    last_ = {load.force_n + rest * difference_.force_n, load.torque_nm + rest * difference_.torque_nm};
    any_ = true;
    return last_;
}

}  // namespace eddy
