#include "firmware/rest_watch.h"

namespace eddy {

void RestWatch::see(Instant now, const std::optional<glm::dvec3>& hand_m, std::uint8_t buttons) {
    now_ = now;
    if (!still_) fluid_moved_ = now;
    const bool came_or_went = hand_m.has_value() != at_.has_value();
    const bool pressed = buttons != buttons_;
    buttons_ = buttons;
    if (!came_or_went && !pressed && !(hand_m && glm::distance(*hand_m, *at_) > kStill_m)) return;
    at_ = hand_m;
    hand_moved_ = now;
}

}  // namespace eddy
