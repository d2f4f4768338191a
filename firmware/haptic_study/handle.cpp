#include "firmware/haptic_study/handle.h"

#include <cmath>

#include "firmware/haptic/stability_limits.h"

namespace eddy::haptic_study {
namespace {

class PathMotion final : public emulated::HandMotion {
  public:
    explicit PathMotion(Path path) : path_(std::move(path)) {}
    glm::dvec3 position_m(Seconds t) const override { return path_(t); }

  private:
    Path path_;
};

/// The lightest handle, and with it the arm of one measured trial (van Beek et al. 2015, Scientific Reports 5:18004: 0.554 kg,
/// 6.45 N s/m, 135 N/m), of which the handle is taken to be a part.
emulated::PlantSettings plant_of(Holder holder) {
    constexpr double kHandleDampingNsM = 0.5;
    emulated::PlantSettings plant{
        .hand = holder == Holder::Fixed ? emulated::Hand::OnPath : emulated::Hand::Arm,
        .handle_mass_kg = kHandleMassKg,
        .handle_damping_ns_m = kHandleDampingNsM,
        .arm_mass_kg = 0.554 - kHandleMassKg,
        .arm_damping_ns_m = 6.45 - kHandleDampingNsM,
        .arm_stiffness_n_m = 135.0};
    if (holder == Holder::StiffArm) {
        plant.arm_damping_ns_m *= 3.0;
        plant.arm_stiffness_n_m *= 3.0;
    }
    return plant;
}

}  // namespace

const char* to_string(Holder holder) {
    switch (holder) {
        case Holder::Fixed:
            return "fixed";
        case Holder::Arm:
            return "arm";
        case Holder::StiffArm:
            return "stiff arm";
        case Holder::LetsGo:
            return "let go";
    }
    return "";
}

Handle::Handle(Holder holder, Path path, Reading reading)
    : plant_(std::make_unique<PathMotion>(std::move(path)), plant_of(holder)), how_(reading) {}

void Handle::poll(Instant now) {
    plant_.advance(now, force_n_);
    if (how_ == Reading::Exact) {
        reading_ = HandleReading{.position_m = plant_.position_m(), .taken_at = now};
        return;
    }
    // What was read a tick ago arrives.
    reading_ = seen_;
    falcon::Axes counts{};
    for (std::size_t leg = 0; leg < counts.size(); ++leg)
        counts[leg] = static_cast<falcon::Axes::value_type>(
            std::lround(falcon::encoder_count(plant_.legs().theta1[leg])));
    if (const auto base = kinematics_.solve(falcon::arm_angles(counts)))
        seen_ = HandleReading{.position_m = falcon::device_from_base(*base), .taken_at = now};
}

}  // namespace eddy::haptic_study
