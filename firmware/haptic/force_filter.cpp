#include "firmware/haptic/force_filter.h"

#include <algorithm>

#include "firmware/haptic/low_pass.h"
#include "firmware/haptic/vector.h"

namespace eddy {

double ForceFilter::cutoff_hz(Seconds fluid_period) const {
    if (!(fluid_period.count() > 0.0)) return settings_.lowest_cutoff_hz;
    return std::clamp(settings_.fraction_of_fluid_rate / fluid_period.count(), settings_.lowest_cutoff_hz,
                      settings_.highest_cutoff_hz);
}

glm::dvec3 ForceFilter::operator()(const glm::dvec3& raw_n, Seconds fluid_period, Seconds dt) {
    if (!is_finite(raw_n)) return raw_n;

    const glm::dvec3 jump = raw_n - filtered_n_;
    const glm::dvec3 let_in = shorten(jump, settings_.impulse_n);
    if (let_in != jump) ++impulses_;

    filtered_n_ += low_pass_weight(cutoff_hz(fluid_period), dt) * let_in;
    return filtered_n_;
}

}  // namespace eddy
