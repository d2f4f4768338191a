#include "firmware/show.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/fluid_setup.h"
#include "gles/body/bounds.h"

namespace eddy {
namespace {

/// Cells between a held body's surface and the walls: enough for the pressure to pass between them.
constexpr double kWallGapCells = 1.5;
/// The fluid's period is smoothed over about this many updates.
constexpr double kPeriodMemory = 8.0;
/// More than this between two updates is no period of the fluid: it stood still, for a night or for a shader.
constexpr double kLongestPeriodS = 1.0;
/// With so many answers under way the oldest is waited for: the GPU works on one step while the next is prepared. More make
/// nothing faster, and each answer a step later.
constexpr std::size_t kMostUnderWay = 2;
/// Steps that an update takes at most.
constexpr double kMostParts = 4.0;
/// A hand that moves faster than this was not followed by the device. The gate cuts the force off from 1 m/s on; hands that
/// hit a ball reach ten times that, but with no Falcon in them.
constexpr double kFastestFollowedMS = 3.0;

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

/// Where the centre of the held body may be.
gles::Extent room_for_hand(const Scene& scene, const gles::FluidSetup& fluid) {
    return gles::room_for_centre(held_extent(scene, fluid), scene.tank.size_m,
                                 kWallGapCells * scene.tank.cell_m());
}

/// A place on the way from where the hand is, no further out of the room than that.
glm::dvec3 inside(const gles::Extent& room, const glm::dvec3& hand_m, const glm::dvec3& place_m) {
    return glm::clamp(place_m, glm::min(room.low, hand_m), glm::max(room.high, hand_m));
}

/// Of what outputs ask for, nothing is written here; and to measure the force in more ways, each step waits for the GPU.
gles::FluidSetup shown(const Scene& scene) {
    gles::FluidSetup setup = fluid_setup(scene);
    setup.force_methods = false;
    // A machine that is always slow takes steps as long as that (exhibit/act.h): were they cut, the body would go further than they do.
    setup.longest_step_s = std::max(setup.longest_step_s, 2.0 * kLongestPeriodS);
    return setup;
}

}  // namespace

HapticOrders orders_for(const Scene& scene, const gles::FluidSetup& fluid) {
    HapticOrders orders;
    orders.enabled = true;
    orders.gain = scene.haptics.gain;
    orders.tank_from_device = {scene.haptics.centre_m, scene.haptics.workspace_scale};
    const gles::Extent room = room_for_hand(scene, fluid);
    orders.lowest_m = room.low;
    orders.highest_m = room.high;
    return orders;
}

Show::Show(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange)
    : Show(gpu, scene, exchange, quality_of(scene)) {}

Show::Show(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange, const Quality& quality)
    : gpu_(gpu),
      scene_(scene),
      exchange_(exchange),
      motions_(scene),
      quality_(quality),
      fluid_(&made(quality_)),
      room_(room_for_hand(scene, fluid_->setup())),
      states_(motions_.at(0.0, scene.solver.dt_s)),
      gain_(scene.haptics.gain) {}

gles::Fluid& Show::made(const Quality& quality) {
    std::unique_ptr<gles::Fluid>& fluid = fluids_[quality];
    if (!fluid) fluid = gles::make_fluid(gpu_, shown(with_quality(scene_, quality)));
    return *fluid;
}

void Show::warm_up(const std::vector<Quality>& qualities) {
    for (const Quality& quality : qualities) take_a_step(made(quality));
    for (std::size_t i = 1; i < qualities.size(); ++i) {
        made(qualities[i]).take_over(made(qualities[i - 1]));
        made(qualities[i - 1]).take_over(made(qualities[i]));
    }
    for (const auto& [quality, fluid] : fluids_) fluid->reset();
}

FluidSlopes Show::slopes() {
    fluid_->reset();
    const FluidSlopes slopes = measure_slopes(*fluid_, scene_, room_);
    fluid_->reset();
    return slopes;
}

const gles::Fluid& Show::make_ready(const Quality& quality) {
    if (is_ready(quality)) return made(quality);
    gles::Fluid& fluid = made(quality);
    take_a_step(fluid);
    fluid.take_over(*fluid_);
    return fluid;
}

void Show::follow(const Show& before) {
    answer_.sequence = before.answer_.sequence;
    received_j_ = before.received_j_;
}

void Show::take_a_step(gles::Fluid& fluid) const {
    fluid.step(scene_.solver.dt_s, motions_.at(0.0, scene_.solver.dt_s), true);
    fluid.wait_result();
}

void Show::set_quality(const Quality& quality) {
    if (quality == quality_) return;
    make_ready(quality);
    gles::Fluid& next = made(quality);
    next.take_over(*fluid_);
    fluid_ = &next;
    quality_ = quality;
    under_way_.clear();
    update_ = {};
    handover_.begin();
}

Seconds Show::usual_step() const {
    return Seconds(std::max(scene_.solver.dt_s, figures_.fluid_period_s));
}

int Show::parts_of(Seconds dt) const {
    if (figures_.steps == 0) return 1;
    // guard sub_steps: a machine that is always slow cannot take more steps, but one that was held up once can
    return static_cast<int>(std::clamp(std::round(dt / usual_step()), 1.0, kMostParts));
}

void Show::update(Instant now, Seconds dt, bool diagnose) {
    const PoseSnapshot pose = exchange_.pose.newest();
    const double interval = figures_.steps > 0 ? Seconds(now - last_).count() : dt.count();
    const int parts = parts_of(dt);
    const Seconds part = dt / parts;
    const auto held = motions_.held();
    const glm::dvec3 from = held ? states_[*held].centre_m : glm::dvec3(0.0);
    const double fastest_m_s = kFastestFollowedMS * scene_.haptics.workspace_scale;
    const glm::dvec3 hand_m = inside(room_, pose.position_m, path_.at(pose, now, fastest_m_s));
    const glm::dvec3 to = pose.known ? hand_m : from;
    // Of the displacement, not of the handle: what the body pushes away must agree with where it goes. But the
    // first position after a gap (a device that has just come, a stall of the fluid) is where the hand happens
    // to be, not a movement, and neither is a leap that no hand makes: the body is placed there, at rest.
    const bool follows = pose.known && hand_known_ && interval <= 1.5 * dt.count();
    const bool leaps = follows && glm::length(to - from) > fastest_m_s * dt.count();  // guard hand_leap
    if (leaps) ++figures_.placed;
    for (int n = 1; n <= parts; ++n) {
        time_s_ += part.count();
        states_ = motions_.at(time_s_, part.count());
        if (held) {
            gles::BodyState& body = states_[*held];
            const bool moved = follows && !leaps;
            body.centre_m = n < parts && moved ? glm::mix(from, to, static_cast<double>(n) / parts) : to;
            body.velocity_m_s = moved ? (to - from) / dt.count() : glm::dvec3(0.0);
        }
        fluid_->step(part.count(), states_, diagnose && n == parts);
        if (!fluid_->bodies().empty()) states_ = fluid_->bodies();  // none if no step could be made of it
        const glm::dvec3 velocity_m_s = held ? states_[*held].velocity_m_s : glm::dvec3(0.0);
        under_way_[fluid_->steps()] = {.answers = n == parts,
                                       .pose_time = pose.time,
                                       .dt_s = part.count(),
                                       .velocity_m_s = velocity_m_s,
                                       .before_m_s = std::exchange(held_velocity_m_s_, velocity_m_s)};
        // A GPU that is slower than the clock would have each step drop the oldest answer, just as it is done (gles/readback.h). Now,
        // not before the next step: that is to have the pose of its own time.
        if (under_way_.size() >= kMostUnderWay) publish(true);
    }
    hand_known_ = held && pose.known;
    figures_.fluid_period_s += (std::min(interval, kLongestPeriodS) - figures_.fluid_period_s) /
                               (figures_.steps > 0 ? kPeriodMemory : 1.0);
    last_ = now;
    ++figures_.steps;
    figures_.sub_steps += parts - 1;
}

gles::GuardCounts Show::guards() const {
    gles::GuardCounts all;
    for (const auto& [quality, fluid] : fluids_) all += fluid->guards();
    return all;
}

void Show::rest(Instant now) {
    last_ = now;
    ++figures_.rested;
    if (answer_.sequence == 0) return;
    ++answer_.sequence;  // a new answer, or the loop would take the fluid for dead
    answer_.computed_for = exchange_.pose.newest().time;
    answer_.velocity_m_s = answer_.acceleration_m_s2 = glm::dvec3(0.0);
    exchange_.fluid.publish(answer_);
}

void Show::reset() {
    fluid_->reset();
    time_s_ = 0.0;
    states_ = motions_.at(0.0, scene_.solver.dt_s);
    under_way_.clear();
    hand_known_ = false;
    path_.forget();
    held_velocity_m_s_ = glm::dvec3(0.0);
    update_ = {};
    stored_j_ = 0.0;
    answer_.force_n = answer_.torque_nm = glm::dvec3(0.0);
    ripple_.reset();
    handover_ = {};
}

void Show::publish(bool wait) {
    while (const auto result = fluid_->result(wait)) {
        wait = false;
        if (result->diagnostics) {
            figures_.divergence_before_1_s = result->diagnostics->divergence_before_1_s;
            figures_.divergence_after_1_s = result->diagnostics->divergence_max_1_s;
            stored_j_ = result->diagnostics->kinetic_energy_j;
            const glm::dvec3& size_m = scene_.tank.size_m;
            const double mass_kg = scene_.fluid.density_kg_m3 * size_m.x * size_m.y * size_m.z;
            figures_.fluid_speed_m_s = std::sqrt(2.0 * result->diagnostics->kinetic_energy_j / mass_kg);
        }
        const auto asked = under_way_.find(result->step);
        const UnderWay step = asked != under_way_.end() ? asked->second : UnderWay{};
        under_way_.erase(under_way_.begin(), under_way_.upper_bound(result->step));
        figures_.fastest_m_s = result->health.fastest_m_s;
        const auto held = motions_.held();
        if (!held) continue;
        // guard force_withheld: the last good force stands, and fades if no other comes (haptic/law.h)
        if (!result->is_sound()) continue;
        update_.add(result->loads[*held], step.dt_s, step.velocity_m_s, step.before_m_s);
        if (!step.answers || update_.seconds() == 0.0) continue;
        const UpdateAnswer update = std::exchange(update_, {});
        const gles::Load load = handover_.hand_on(
            update.load(), {update.velocity_m_s(), update.acceleration_m_s2()}, step.pose_time);
        // Over the mean velocity: what is taken to set the fluid around the body moving comes back when it stops. By the load
        // of its own: what the handover adds for a while it never received.
        received_j_ -= glm::dot(update.load().force_n, update.mean_velocity_m_s()) * update.seconds();
        const Instant computed_for = step.pose_time;
        answer_ = {.force_n = load.force_n,
                   .torque_nm = load.torque_nm,
                   .sequence = answer_.sequence + 1,
                   .computed_for = computed_for,
                   .fluid_period = Seconds(figures_.fluid_period_s),
                   .velocity_m_s = update.velocity_m_s(),
                   .acceleration_m_s2 = update.acceleration_m_s2(),
                   .received_j = received_j_,
                   .stored_j = stored_j_};
        exchange_.fluid.publish(answer_);
        const glm::dvec3 felt_force = load.force_n * gain_;
        ripple_.add(computed_for, felt_force);
        const double felt = glm::length(felt_force);
        figures_.least_force_n = std::min(figures_.least_force_n.value_or(felt), felt);
        figures_.most_force_n = std::max(figures_.most_force_n, felt);
    }
}

}  // namespace eddy
