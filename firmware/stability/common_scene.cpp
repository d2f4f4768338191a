#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/stability/case.h"

namespace eddy::stability {

Scene common_scene(const Trial& trial) {
    const glm::ivec3& n = trial.cells;
    Scene scene;
    scene.title = "Hard case";
    const double cell_m = 0.16 / std::max({n.x, n.y, n.z});
    scene.tank.cells = n;
    scene.tank.size_m = cell_m * glm::dvec3(n);
    const glm::dvec3 middle = 0.5 * scene.tank.size_m;
    const double side = std::min({scene.tank.size_m.x, scene.tank.size_m.y, scene.tank.size_m.z});

    scene.smoke.emplace().initial = Formula::parse(fmt::format(
        "(x - {0:.9f}) * (x - {0:.9f}) + (y - {1:.9f}) * (y - {1:.9f}) + (z - {2:.9f}) * (z - {2:.9f}) "
        "< {3:.12f}",
        0.6 * middle.x, 1.3 * middle.y, middle.z, 0.04 * side * side));

    Scene::Body& ball = scene.bodies.emplace_back();
    ball.name = "ball";
    ball.radius_m = 0.2 * side;
    ball.centre_m = middle;
    ball.motion = BodyMotion::Held;

    scene.haptics.gain = 20000.0;  // that of the shipped scenes with air
    scene.haptics.centre_m = middle;

    scene.solver.dt_s = 0.02;
    scene.solver.preset = trial.effort == Effort::Default ? SolverPreset::Precise : SolverPreset::Fast;
    if (trial.effort == Effort::Least) {
        scene.solver.cycles = 1;
        scene.solver.viscous_cycles = 1;
    }
    return scene;
}

void falls_silent(Scene& scene, double stop_s) {
    // Times are sums of steps. A source counts as it is when a step begins, a wall as it is when it ends.
    const double half_s = 0.5 * scene.solver.dt_s;
    for (Scene::Source& source : scene.sources)
        source.stop_s = std::min(stop_s - half_s, source.stop_s.value_or(stop_s));
    for (Scene::Wall* wall : scene.tank.walls.all()) {
        if (!wall->velocity_m_s) continue;
        for (Formula* u : {&wall->velocity_m_s->x, &wall->velocity_m_s->y, &wall->velocity_m_s->z}) {
            if (u->constant() == 0.0) continue;
            const std::string before = u->source() ? *u->source() : fmt::format("{:.17g}", *u->constant());
            *u = Formula::parse(fmt::format("({}) * (t < {:.9g})", before, stop_s + half_s));
        }
    }
}

double running_down_s(double time_s, double stop_s) {
    const double since_s = std::min(time_s - stop_s, kRunDownS);
    return since_s > 0.0 ? stop_s + since_s - 0.5 * since_s * since_s / kRunDownS : time_s;
}

glm::dvec3 stroke_m(const Moment& moment) {
    if (!moment.disturbs()) return moment.middle_m();
    const glm::dvec3& size = moment.scene->tank.size_m;
    const double side = std::min({size.x, size.y, size.z});
    const double t = 2.0 * std::numbers::pi * (moment.time_s + moment.dt_s);
    return moment.middle_m() + side * glm::dvec3(0.15 * std::sin(t), 0.1 * std::sin(0.7 * t), 0.0);
}

}  // namespace eddy::stability
