#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "hal/haptic/haptic_device.h"

namespace eddy {

/// A device that answers every poll with a scripted position, until told to fall silent. Keeps the last
/// command.
struct ScriptedDevice final : HapticDevice {
    std::function<glm::dvec3(Seconds)> path = [](Seconds) { return glm::dvec3(0.0); };
    HapticState is = HapticState::Ready;
    bool answers = true;
    bool sure = true;

    std::optional<HandleReading> waiting;
    Seconds last_reply{-std::numeric_limits<double>::infinity()};
    glm::dvec3 commanded_n{0.0};
    int zeros_in_a_row = 0;
    HandleLight light{};

    void poll(Instant now) override {
        if (!answers) return;
        last_reply = now;
        if (is == HapticState::Ready) waiting = HandleReading{.position_m = path(now), .taken_at = now};
    }
    std::optional<HandleReading> read() override { return std::exchange(waiting, std::nullopt); }
    void command(const glm::dvec3& force_n) override {
        commanded_n = force_n;
        zeros_in_a_row = force_n == glm::dvec3(0.0) ? zeros_in_a_row + 1 : 0;
    }
    void show(const HandleLight& shown) override { light = shown; }
    bool obeys() const override { return sure; }
    HapticState state() const override { return is; }
    HapticCounters counters() const override { return {}; }
    Seconds silence(Instant now) const override { return Seconds(now) - last_reply; }
    std::string describe() const override { return "scripted"; }
};

}  // namespace eddy
