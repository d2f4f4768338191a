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

/// The way of a body that sets off at this speed.
double length_m(double speed_m_s, double dt_s) {
    return speed_m_s * dt_s * (kStepsAtSpeed + kMore * kStepsAtMore);
}

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

/// Of a body that goes through `middle_m` along an axis.
FluidSlopes along(int axis, Probe& probe, const glm::dvec3& middle_m, double speed_m_s) {
    glm::dvec3 way(0.0);
    way[axis] = 1.0;
    const double dt = probe.dt_s();
    glm::dvec3 at_m = middle_m - 0.5 * length_m(speed_m_s, dt) * way;
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

/// Where a body has most room among the others, taken for the balls that hold them: the first of some places where it has enough [m].
/// Inside another it would feel nothing, and no gain would be too much.
glm::dvec3 place_among(const std::vector<gles::BodySetup>& bodies, const std::vector<gles::BodyState>& states,
                       std::size_t held, const std::vector<glm::dvec3>& places_m, double enough_m) {
    const auto clear_m = [&](const glm::dvec3& place_m) {
        double least_m = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (i == held || bodies[i].inside_out) continue;
            const double apart_m = glm::distance(place_m, gles::middle_m(bodies[i].shape, states[i]));
            least_m = std::min(least_m, apart_m - gles::bounding_ball(bodies[i].shape).radius_m);
        }
        return least_m - gles::bounding_radius_m(bodies[held].shape);
    };
    const auto found = std::find_if(places_m.begin(), places_m.end(),
                                    [&](const glm::dvec3& place_m) { return clear_m(place_m) >= enough_m; });
    if (found != places_m.end()) return *found;
    return *std::max_element(places_m.begin(), places_m.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
        return clear_m(a) < clear_m(b);
    });
}

/// The handle's middle, and a grid over the room.
std::vector<glm::dvec3> places_in(const gles::Extent& room, const glm::dvec3& first_m) {
    std::vector<glm::dvec3> places_m{glm::clamp(first_m, room.low, room.high)};
    constexpr double kShares[] = {0.5, 0.25, 0.75, 0.0, 1.0};
    for (const double x : kShares)
        for (const double y : kShares)
            for (const double z : kShares)
                places_m.push_back(glm::mix(room.low, room.high, glm::dvec3(x, y, z)));
    return places_m;
}

}  // namespace

FluidSlopes measure_slopes(gles::Fluid& fluid, const Scene& scene, const gles::Extent& room) {
    const BodySchedule schedule(scene);
    const auto held = schedule.held();
    if (!held) return {};
    Probe probe(fluid, scene);
    const double dt = scene.solver.dt_s, brisk_m_s = scene.haptics.workspace_scale * kSpeedMS;
    const glm::dvec3& size_m = scene.tank.size_m;
    const double third_m = std::min({size_m.x, size_m.y, size_m.z}) / 3.0;
    const glm::dvec3 place_m = place_among(fluid.setup().bodies, schedule.at(0.0, dt), *held,
                                           places_in(room, scene.haptics.centre_m),
                                           0.5 * std::min(third_m, length_m(brisk_m_s, dt)));
    FluidSlopes most;
    const bool alike = scene.bodies.size() == 1 && scene.bodies[*held].shape == BodyShape::Sphere;
    const glm::dvec3 room_m = room.high - room.low;
    const int widest = room_m.x >= std::max(room_m.y, room_m.z) ? 0 : room_m.y >= room_m.z ? 1 : 2;
    for (int axis = 0; axis < 3; ++axis) {
        if (alike && axis != widest) continue;
        // In a small tank or with long steps it goes more slowly, over a third of the tank; and no further than the hand may.
        const double way_m = std::min(third_m, room_m[axis]);
        if (way_m < 0.5 * scene.tank.cell_m()) continue;  // the grid would hardly see it move
        const double speed_m_s = brisk_m_s * std::min(1.0, way_m / length_m(brisk_m_s, dt));
        const double half_m = 0.5 * length_m(speed_m_s, dt);
        glm::dvec3 middle_m = place_m;
        middle_m[axis] = std::clamp(place_m[axis], room.low[axis] + half_m,
                                    std::max(room.low[axis] + half_m, room.high[axis] - half_m));
        const FluidSlopes slopes = along(axis, probe, middle_m, speed_m_s);
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
