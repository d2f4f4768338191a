#include "firmware/rest_watch.h"

#include <algorithm>

namespace eddy {

bool moves_by_itself(const Scene& scene) {
    const auto is_driven = [](const Scene::Body& body) { return body.motion == BodyMotion::Prescribed; };
    const auto blows = [](const Scene::Source& source) {
        return source.velocity_m_s || source.start_s > 0.0;
    };
    const auto through = [](const Scene::Wall* wall) {
        return wall->kind == WallKind::Inflow || wall->velocity_m_s;
    };
    const auto walls = scene.tank.walls.all();
    // Warm and heavy fluid goes on for minutes where it is thick, too slowly for all of it to show.
    const bool weighs = (scene.smoke && scene.smoke->weight != 0.0) ||
                        (scene.temperature && scene.temperature->expansion_1_k != 0.0);
    return (weighs && scene.fluid.gravity_m_s2 != glm::dvec3(0.0)) || scene.imposed || scene.forcing ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(), is_driven) ||
           std::any_of(scene.sources.begin(), scene.sources.end(), blows) ||
           std::any_of(walls.begin(), walls.end(), through);
}

void RestWatch::see(Instant now, const std::optional<glm::dvec3>& hand_m, std::uint8_t buttons) {
    now_ = now;
    if (!began_) hand_moved_ = now;
    began_ = true;
    if (!still_) fluid_moved_ = now;
    const bool came_or_went = hand_m.has_value() != at_.has_value();
    const bool pressed = buttons != buttons_;
    buttons_ = buttons;
    if (!came_or_went && !pressed && !(hand_m && glm::distance(*hand_m, *at_) > still_m_)) return;
    at_ = hand_m;
    hand_moved_ = now;
    if (!came_or_went) touched_ = now;
}

}  // namespace eddy
