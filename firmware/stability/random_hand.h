#pragma once
#include <optional>
#include <string>

#include "firmware/stability/draw.h"
#include "hal/haptic/haptic_device.h"

namespace eddy::stability {

/// A hand that the seed decides, on a device that does as it likes. Acts of 10 ms to 2 s follow each other: the handle rests,
/// stirs, trembles, darts, leaps, or is at places that are none (nan, infinite, 1e30 m); the device is silent, or away.
class RandomHand final : public HapticDevice {
  public:
    enum class Act { Rests, Stirs, Trembles, Darts, Leaps, Nonsense, Silent, Away };

    explicit RandomHand(std::uint64_t seed) : draw_(seed) {}

    void poll(Instant now) override;
    std::optional<HandleReading> read() override;
    void command(const glm::dvec3&) override {}
    bool obeys() const override { return state_ == HapticState::Ready && act_ != Act::Silent; }
    void show(const HandleLight&) override {}
    HapticState state() const override { return state_; }
    HapticCounters counters() const override { return {}; }
    Seconds silence(Instant now) const override;
    std::string describe() const override { return "a hand that chance moves"; }

    Act act() const { return act_; }

  private:
    void begin_act(Instant now);
    glm::dvec3 position_m(Seconds since);
    glm::dvec3 nonsense_m();

    Draw draw_;
    Act act_ = Act::Rests;
    Instant began_{0}, ends_{0};
    glm::dvec3 from_m_{0.0}, at_m_{0.0}, swing_m_{0.0};  // Device frame
    double turns_per_s_ = 0.0;
    HapticState state_ = HapticState::Ready;
    std::optional<HandleReading> reading_;
    std::optional<Instant> answered_;
};

}  // namespace eddy::stability
