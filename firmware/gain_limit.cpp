#include "firmware/gain_limit.h"

#include <algorithm>
#include <limits>

#include "firmware/body_schedule.h"
#include "firmware/haptic/stability_limits.h"
#include "gles/body/bounds.h"

namespace eddy {
namespace {

/// Of the hand, brisk; as much again as a half is added to see how the force grows.
constexpr double kSpeedMS = 0.2, kMore = 1.5;
constexpr int kStepsAtSpeed = 5, kStepsAtMore = 5;

/// Moves the held body, step by step, and tells the force on it.
class Probe {
  public:
    Probe(gles::Fluid& fluid, const Scene& scene)
        : fluid_(fluid), schedule_(scene), dt_s_(scene.solver.dt_s), held_(*schedule_.held()) {}

    double dt_s() const { return dt_s_; }
    glm::dvec3 step(const glm::dvec3& centre_m, const glm::dvec3& velocity_m_s) {
        std::vector<gles::BodyState> states = schedule_.at(static_cast<double>(++steps_) * dt_s_, dt_s_);
        states[held_].centre_m = centre_m;
        states[held_].velocity_m_s = velocity_m_s;
        fluid_.step(dt_s_, states, false);
        return fluid_.wait_result().loads[held_].force_n;
    }

  private:
    gles::Fluid& fluid_;
    BodySchedule schedule_;
    double dt_s_;
    std::size_t held_;
    long steps_ = 0;
};

FluidSlopes along(int axis, Probe& probe, const glm::dvec3& middle_m, double speed_m_s) {
    glm::dvec3 way(0.0);
    way[axis] = 1.0;
    const double dt = probe.dt_s();
    const double length_m = speed_m_s * dt * (kStepsAtSpeed + kMore * kStepsAtMore);
    glm::dvec3 at_m = middle_m - 0.5 * length_m * way;
    probe.step(at_m, glm::dvec3(0.0));
    const glm::dvec3 still_n = probe.step(at_m, glm::dvec3(0.0));
    glm::dvec3 start_n(0.0), force_n = still_n, before_n = still_n;
    for (int n = 0; n < kStepsAtSpeed + kStepsAtMore; ++n) {
        const double v = n < kStepsAtSpeed ? speed_m_s : kMore * speed_m_s;
        at_m += v * dt * way;
        force_n = probe.step(at_m, v * way);
        if (n == 0) start_n = force_n;
        if (n == kStepsAtSpeed - 1) before_n = force_n;
    }
    // Set off within a step, all but the added mass is small; when it has gone some steps at more speed, only the drag has grown.
    const double added = -glm::dot(start_n - still_n, way) / (speed_m_s / dt);
    const double drag = -glm::dot(force_n - before_n, way) / ((kMore - 1.0) * speed_m_s);
    return {std::max(0.0, drag), std::max(0.0, added)};
}

}  // namespace

FluidSlopes measure_slopes(gles::Fluid& fluid, const Scene& scene) {
    const auto held = BodySchedule(scene).held();
    if (!held) return {};
    Probe probe(fluid, scene);
    const double length_m =
        scene.haptics.workspace_scale * kSpeedMS * scene.solver.dt_s * (kStepsAtSpeed + kMore * kStepsAtMore);
    // In a small tank or with long steps it goes more slowly, over a third of the tank.
    const glm::dvec3& size_m = scene.tank.size_m;
    const double room_m = std::min({size_m.x, size_m.y, size_m.z}) / 3.0;
    const double speed_m_s = scene.haptics.workspace_scale * kSpeedMS * std::min(1.0, room_m / length_m);
    FluidSlopes most;
    const int axes = scene.bodies[*held].shape == BodyShape::Sphere ? 1 : 3;
    for (int axis = 0; axis < axes; ++axis) {
        const FluidSlopes slopes = along(axis, probe, 0.5 * size_m, speed_m_s);
        most.drag_ns_m = std::max(most.drag_ns_m, slopes.drag_ns_m);
        most.added_kg = std::max(most.added_kg, slopes.added_kg);
    }
    return most;
}

double most_gain(const FluidSlopes& slopes, double workspace_scale, Seconds fluid_period) {
    double most = std::numeric_limits<double>::infinity();
    if (slopes.drag_ns_m > 0.0)
        most = std::min(most, most_drag_ns_m(fluid_period) / (workspace_scale * slopes.drag_ns_m));
    if (slopes.added_kg > 0.0) most = std::min(most, kMostAddedKg / (workspace_scale * slopes.added_kg));
    return most;
}

}  // namespace eddy
