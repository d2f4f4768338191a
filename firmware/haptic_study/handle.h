#pragma once
#include <functional>
#include <optional>

#include "hal/haptic/emulated/plant.h"
#include "hal/haptic/haptic_device.h"

namespace eddy::haptic_study {

/// Where a hand wants to be [m, Device frame].
using Path = std::function<glm::dvec3(Seconds)>;

enum class Holder {
    Fixed,     ///< stronger than any force: the handle is where the path says
    Arm,       ///< a person's arm pulls it there
    StiffArm,  ///< with three times the stiffness and damping
    LetsGo     ///< an arm, until let_go()
};
const char* to_string(Holder holder);

enum class Reading {
    Encoders,  ///< to the nearest count, a tick late
    Exact      ///< where it is, at once: for references
};

/// A handle whose position is read off its encoders a tick late, and which feels what its motors are told. Ready at once.
class Handle final : public HapticDevice {
  public:
    Handle(Holder holder, Path path, Reading reading = Reading::Encoders);

    void let_go() { plant_.let_go(); }
    /// Where it really is.
    glm::dvec3 position_m() const { return plant_.position_m(); }

    void poll(Instant now) override;
    std::optional<HandleReading> read() override { return std::exchange(reading_, std::nullopt); }
    void command(const glm::dvec3& force_n) override { force_n_ = force_n; }
    void show(const HandleLight&) override {}
    HapticState state() const override { return HapticState::Ready; }
    HapticCounters counters() const override { return {}; }
    Seconds silence(Instant) const override { return Seconds(0.0); }
    std::string describe() const override { return "a handle of the laboratory"; }

  private:
    emulated::Plant plant_;
    Reading how_;
    falcon::ForwardKinematics kinematics_;
    glm::dvec3 force_n_{0.0};
    std::optional<HandleReading> seen_, reading_;
};

}  // namespace eddy::haptic_study
