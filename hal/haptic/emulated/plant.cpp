#include "hal/haptic/emulated/plant.h"

#include <algorithm>
#include <utility>

namespace eddy::emulated {
namespace {

using namespace std::chrono_literals;

constexpr Instant kStep = 250us;     // far below the fastest time constant here, m/b = 110 ms
constexpr double kGravity = 9.81;    // [m/s2]
constexpr Instant kLongestGap = 1s;  // after a longer one the handle starts afresh instead of catching up

// Stops: +-60 mm across, z 65..178 mm from the base (libnifalcon's HDAL layer reports 75..175; the legs end
// near 60 and 183).
constexpr glm::dvec3 kLowStop{-0.060, -0.060, 0.065 - falcon::kDeviceOriginZ};
constexpr glm::dvec3 kHighStop{0.060, 0.060, 0.178 - falcon::kDeviceOriginZ};

std::optional<falcon::Legs> legs_at(const glm::dvec3& p) {
    return falcon::inverse_kinematics(falcon::base_from_device(p));
}

}  // namespace

Plant::Plant(std::unique_ptr<HandMotion> motion, const PlantSettings& settings)
    : motion_(std::move(motion)), settings_(settings) {
    start(Instant(0));
}

void Plant::start(Instant at) {
    time_ = at;
    place(motion_->position_m(at));
    velocity_ = glm::dvec3(0.0);
}

void Plant::advance(Instant to, const glm::dvec3& force_n) {
    if (to - time_ > kLongestGap) start(to);
    if (settings_.hand == Hand::OnPath && to > time_) follow(to);
    while (time_ < to) {
        const Instant next = std::min(to, time_ + kStep);
        const Seconds dt = next - time_;
        time_ = next;
        step(dt.count(), force_n);
    }
}

void Plant::follow(Instant to) {
    const glm::dvec3 before = position_;
    place(motion_->position_m(to));
    velocity_ = (position_ - before) / Seconds(to - time_).count();
    time_ = to;
}

void Plant::step(double dt, const glm::dvec3& force_n) {
    const Seconds now = time_;
    const glm::dvec3 target = motion_->position_m(now);
    const glm::dvec3 target_velocity =
        (target - motion_->position_m(now - Seconds(kStep))) / Seconds(kStep).count();

    // (m_handle + m_arm + m_hung) a = F_motors + k (target - x) + b_arm (target' - v) - b_handle v + m_hung g, the
    // dampers implicitly. Without a hand there is no arm.
    const double held = settings_.hand == Hand::None ? 0.0 : 1.0;
    const double mass = settings_.handle_mass_kg + held * settings_.arm_mass_kg + hung_kg_;
    const double damping = settings_.handle_damping_ns_m + held * settings_.arm_damping_ns_m;
    const glm::dvec3 push = force_n + glm::dvec3(0.0, -kGravity * hung_kg_, 0.0) +
                            held * settings_.arm_stiffness_n_m * (target - position_) +
                            held * settings_.arm_damping_ns_m * target_velocity;
    velocity_ = (velocity_ + dt / mass * push) / (1.0 + dt / mass * damping);

    // Dry friction takes away so much speed, and stops what is slower.
    const double speed = glm::length(velocity_);
    const double rubbed = dt / mass * settings_.handle_friction_n;
    if (rubbed > 0.0) velocity_ *= speed > rubbed ? 1.0 - rubbed / speed : 0.0;

    const glm::dvec3 wanted = position_ + dt * velocity_;
    place(wanted);
    // A stop takes away the speed that runs into it and no more.
    const glm::dvec3 beyond = wanted - position_;
    const double depth = glm::length(beyond);
    if (depth > 0.0) velocity_ -= std::max(0.0, glm::dot(velocity_, beyond / depth)) * beyond / depth;
}

void Plant::place(const glm::dvec3& wanted) {
    position_ = glm::clamp(wanted, kLowStop, kHighStop);
    auto legs = legs_at(position_);
    if (!legs) {
        // Where the legs do not reach, the handle stops on the way from the middle of the workspace.
        double inside = 0.0;
        double outside = 1.0;
        for (int halving = 0; halving < 30; ++halving) {
            const double middle = (inside + outside) / 2.0;
            (legs_at(middle * position_) ? inside : outside) = middle;
        }
        position_ *= inside;
        legs = legs_at(position_);
    }
    legs_ = *legs;
}

}  // namespace eddy::emulated
