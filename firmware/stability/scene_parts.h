#pragma once
#include "config/scene.h"

namespace eddy::stability {

// Short words for what the cases change in a scene.

inline double shortest_side_m(const Scene& scene) {
    const glm::dvec3& size = scene.tank.size_m;
    return std::min({size.x, size.y, size.z});
}

/// A formula's text, or a number, for each component.
inline FormulaVector vector_of(const Formula& x, const Formula& y, const Formula& z) {
    return {x, y, z};
}
inline FormulaVector vector_of(const glm::dvec3& v) {
    return {Formula(v.x), Formula(v.y), Formula(v.z)};
}

/// A box that moves as prescribed.
inline Scene::Body box(const std::string& name, const glm::dvec3& centre_m, const glm::dvec3& size_m) {
    Scene::Body body;
    body.name = name;
    body.shape = BodyShape::Box;
    body.size_m = size_m;
    body.centre_m = centre_m;
    body.motion = BodyMotion::Prescribed;
    return body;
}

inline Scene::Body sphere(const std::string& name, const glm::dvec3& centre_m, double radius_m) {
    Scene::Body body;
    body.name = name;
    body.radius_m = radius_m;
    body.centre_m = centre_m;
    body.motion = BodyMotion::Prescribed;
    return body;
}

inline Scene::Oscillation swing(const glm::dvec3& amplitude_m, double frequency_hz, double phase_rad = 0.0) {
    return {.amplitude_m = amplitude_m, .frequency_hz = frequency_hz, .phase_rad = phase_rad};
}

inline void all_walls(Scene& scene, WallKind kind) {
    for (Scene::Wall* wall : scene.tank.walls.all()) wall->kind = kind;
}

/// The body that the hand holds in the common scene, to be made something else of.
inline Scene::Body& ball(Scene& scene) {
    if (scene.bodies.empty())
        scene.bodies.push_back(sphere("ball", 0.5 * scene.tank.size_m, 0.2 * shortest_side_m(scene)));
    return scene.bodies.front();
}

/// In at x low, out at x high.
inline void stream_through(Scene& scene, const FormulaVector& velocity_m_s) {
    scene.tank.walls.x_low = {WallKind::Inflow, velocity_m_s};
    scene.tank.walls.x_high = {WallKind::Open, {}};
}

}  // namespace eddy::stability
