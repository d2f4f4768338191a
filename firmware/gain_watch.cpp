#include "firmware/gain_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy {

bool GainWatch::see(Seconds fluid_period, Seconds lateness) {
    constexpr double kStep = 0.1;
    const double wanted = std::min(scene_gain_, most_gain(slopes_, scale_, std::max(fluid_period, lateness)));
    const bool at_top = wanted == scene_gain_ && gain() != scene_gain_;
    if (gain_ && !at_top && std::abs(wanted - *gain_) <= kStep * *gain_) return false;
    changes_ += gain_ ? 1 : 0;
    gain_ = gain_ ? std::clamp(wanted, (1.0 - kStep) * *gain_, (1.0 + kStep) * *gain_) : wanted;
    period_ = fluid_period;
    lateness_ = lateness;
    return true;
}

std::optional<std::string> GainWatch::news() {
    if (told_ || gain() >= scene_gain_) return std::nullopt;
    told_ = true;
    return fmt::format(
        "the gain is held at {:.0f} % of the scene's {}: at {:.0f} answers a second{}, with all of it, a "
        "handle that nobody "
        "holds would not stay still; it would be a drag of {:.2g} N s/m and an added mass of {:.2g} kg",
        100.0 * gain() / scene_gain_, scene_gain_, 1.0 / period_.count(),
        lateness_ > period_ ? fmt::format(", {:.0f} ms after the hand", 1e3 * lateness_.count()) : "",
        scene_gain_ * scale_ * slopes_.drag_ns_m, scene_gain_ * scale_ * slopes_.added_kg);
}

}  // namespace eddy
