#include "firmware/show.h"

#include <algorithm>

#include "firmware/fluid_setup.h"
#include "gles/body/bounds.h"

namespace eddy {
namespace {

/// Cells between a held body's surface and the walls: enough for the pressure to pass between them.
constexpr double kWallGapCells = 1.5;
/// The fluid's period is smoothed over about this many updates.
constexpr double kPeriodMemory = 8.0;

/// What the held body fills around its centre, however it turns in the hand if it does; nothing if none is held.
gles::Extent held_extent(const Scene& scene, const gles::FluidSetup& fluid) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].motion != BodyMotion::Held) continue;
        const gles::Shape& shape = fluid.bodies[i].shape;
        if (!scene.bodies[i].turning) return gles::extent(shape, scene.bodies[i].orientation());
        const glm::dvec3 radius(gles::bounding_radius_m(shape));
        return {-radius, radius};
    }
    return {glm::dvec3(0.0), glm::dvec3(0.0)};
}

/// Of what outputs ask for, nothing is written here; and to measure the force in more ways, each step waits for the GPU.
gles::FluidSetup shown(const Scene& scene) {
    gles::FluidSetup setup = fluid_setup(scene);
    setup.force_methods = false;
    return setup;
}

}  // namespace

HapticOrders orders_for(const Scene& scene, const gles::FluidSetup& fluid) {
    HapticOrders orders;
    orders.enabled = true;
    orders.gain = scene.haptics.gain;
    orders.tank_from_device = {scene.haptics.centre_m, scene.haptics.workspace_scale};
    const gles::Extent room = gles::room_for_centre(held_extent(scene, fluid), scene.tank.size_m,
                                                    kWallGapCells * scene.tank.cell_m());
    orders.lowest_m = room.low;
    orders.highest_m = room.high;
    return orders;
}

Show::Show(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange)
    : scene_(scene),
      exchange_(exchange),
      motions_(scene),
      fluid_(gles::make_fluid(gpu, shown(scene))),
      states_(motions_.at(0.0, scene.solver.dt_s)) {}

void Show::warm_up() {
    fluid_->step(scene_.solver.dt_s, states_, true);
    fluid_->wait_result();
    fluid_->reset();
}

void Show::update(Instant now, Seconds dt, bool diagnose) {
    const PoseSnapshot pose = exchange_.pose.newest();
    const double interval = figures_.steps > 0 ? Seconds(now - last_).count() : dt.count();
    time_s_ += dt.count();
    const std::vector<gles::BodyState> before = states_;
    states_ = motions_.at(time_s_, dt.count());
    if (const auto held = motions_.held()) {
        gles::BodyState& body = states_[*held];
        body.centre_m = pose.known ? pose.position_m : before[*held].centre_m;
        // Of the displacement, not of the handle: what the body pushes away must agree with where it goes. But the
        // first position after a gap (a device that has just come, a stall of the fluid) is where the hand happens
        // to be, not a movement: the body is placed there, at rest.
        const bool moved = pose.known && hand_known_ && interval <= 1.5 * dt.count();
        body.velocity_m_s = moved ? (body.centre_m - before[*held].centre_m) / dt.count() : glm::dvec3(0.0);
        hand_known_ = pose.known;
    }
    figures_.fluid_period_s +=
        (interval - figures_.fluid_period_s) / (figures_.steps > 0 ? kPeriodMemory : 1.0);
    last_ = now;
    ++figures_.steps;
    fluid_->step(dt.count(), states_, diagnose);
    states_ = fluid_->bodies();
    computed_for_[fluid_->steps()] = pose.time;
}

void Show::reset() {
    fluid_->reset();
    time_s_ = 0.0;
    states_ = motions_.at(0.0, scene_.solver.dt_s);
    computed_for_.clear();
    hand_known_ = false;
    ripple_.reset();
}

void Show::publish(bool wait) {
    while (const auto result = fluid_->result(wait)) {
        wait = false;
        if (result->diagnostics) {
            figures_.divergence_before_1_s = result->diagnostics->divergence_before_1_s;
            figures_.divergence_after_1_s = result->diagnostics->divergence_max_1_s;
        }
        const Instant computed_for = computed_for_[result->step];
        computed_for_.erase(computed_for_.begin(), computed_for_.upper_bound(result->step));
        const auto held = motions_.held();
        if (!held) continue;
        const gles::Load& load = result->loads[*held];
        exchange_.fluid.publish(
            {load.force_n, load.torque_nm, ++sequence_, computed_for, Seconds(figures_.fluid_period_s)});
        const glm::dvec3 felt_force = load.force_n * scene_.haptics.gain;
        ripple_.add(computed_for, felt_force);
        const double felt = glm::length(felt_force);
        figures_.least_force_n = sequence_ == 1 ? felt : std::min(figures_.least_force_n, felt);
        figures_.most_force_n = std::max(figures_.most_force_n, felt);
    }
}

}  // namespace eddy
