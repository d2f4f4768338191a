#pragma once
#include <functional>
#include <memory>
#include <utility>

#include "hal/haptic/emulated/emulated_falcon.h"
#include "hal/haptic/falcon/falcon.h"
#include "tests/hal/haptic/synthetic_firmware.h"

namespace eddy {

/// A hand that follows a function of time [s].
class Path final : public emulated::HandMotion {
  public:
    explicit Path(std::function<glm::dvec3(double)> path) : path_(std::move(path)) {}
    glm::dvec3 position_m(Seconds t) const override { return path_(t.count()); }

  private:
    std::function<glm::dvec3(double)> path_;
};

inline std::unique_ptr<Path> still(const glm::dvec3& p = glm::dvec3(0.0)) {
    return std::make_unique<Path>([p](double) { return p; });
}

/// A driver, polled and commanded 1000 times a second of virtual time.
struct DriverRig {
    virtual ~DriverRig() = default;
    /// The next millisecond begins, for the device too.
    virtual void advance() = 0;
    virtual emulated::EmulatedFalcon& device() = 0;
    emulated::EmulatedBoard& board() { return device().board(); }

    void tick(const glm::dvec3& force_n = glm::dvec3(0.0)) {
        advance();
        driver->poll(now);
        if (const auto reading = driver->read()) {
            last = *reading;
            ++readings;
        }
        driver->command(force_n);
    }
    void run(int ms, const glm::dvec3& force_n = glm::dvec3(0.0)) {
        for (int i = 0; i < ms; ++i) tick(force_n);
    }
    /// Milliseconds until the driver is in this state; -1 if it does not get there in time.
    int until(HapticState state, int at_most_ms, const glm::dvec3& force_n = glm::dvec3(0.0)) {
        for (int ms = 0; ms <= at_most_ms; ++ms) {
            if (driver->state() == state) return ms;
            tick(force_n);
        }
        return -1;
    }

    Instant now{0};
    std::unique_ptr<Falcon> driver;
    HandleReading last;
    int readings = 0;
};

/// The driver above the emulated Falcon.
struct Rig : DriverRig {
    explicit Rig(emulated::BoardSettings board = {}, FalconSettings settings = {},
                 std::unique_ptr<emulated::HandMotion> motion = still(),
                 emulated::PlantSettings plant = {.hand = emulated::Hand::OnPath}) {
        auto emulated = std::make_unique<emulated::EmulatedFalcon>(std::move(motion), plant, board);
        device_ = emulated.get();
        driver = std::make_unique<Falcon>(std::move(emulated), std::move(settings));
    }

    void advance() override { now += std::chrono::milliseconds(1); }
    emulated::EmulatedFalcon& device() override { return *device_; }

  private:
    emulated::EmulatedFalcon* device_ = nullptr;
};

inline emulated::BoardSettings cold() {
    return {.start = emulated::BoardState::Cold};
}
/// Its own watchdog takes no torque away, for so long: what comes to an end sooner, the driver ended.
inline emulated::BoardSettings left_to_the_driver() {
    return {.watchdog = std::chrono::seconds(1)};
}
inline emulated::BoardSettings unhomed() {
    return {.start = emulated::BoardState::RunUnhomed};
}
inline FalconSettings with_firmware(std::uint16_t words = 4230) {
    return {.firmware_image = synthetic_firmware(words)};
}

}  // namespace eddy
