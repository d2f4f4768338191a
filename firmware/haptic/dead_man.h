#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "firmware/haptic/force_gate.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

struct HapticInput;

/// How often no hand was felt on the handle.
struct DeadManCounters {
    std::uint64_t released = 0;
    std::uint64_t false_alarms = 0;  ///< of these: it moved again so soon that a hand must have been there
};

/// The dead man's switch that a Falcon does not have: whether anybody holds the handle, and whether somebody stopped it all.
/// A hand that holds something trembles, at 8 to 12 Hz and by more than an encoder's step; a handle that lies on its stop, or
/// hangs in its friction, does not move at all. What it cannot see is a handle that was let go and still moves: that is for
/// the gate, which shuts at kFastestHandMS.
class DeadMan {
  public:
    /// Nobody holds a handle that keeps within this distance for so long. Two encoder counts at the handle.
    static constexpr double kStillM = 0.1e-3;
    static constexpr Instant kStillFor = std::chrono::seconds(5);
    /// Somebody has taken it up that moves it so far; the vibrations of a building do not.
    static constexpr double kTakenUpM = 0.5e-3;
    /// Taken up within this time, it had not been let go.
    static constexpr Instant kFalseAlarm = std::chrono::seconds(2);

    /// Once a tick. Open, or why there may be no force: Released or Stopped.
    GateReason operator()(const HapticInput& in);

    const DeadManCounters& counters() const { return counters_; }
    /// Its bytes are a state that it can be in (sound.h).
    bool is_sound() const;

  private:
    void feel(const HandleReading& reading, Instant now);

    bool stopped_ = false;
    std::uint64_t restarts_ = 0;
    bool felt_ = false;  ///< there was a reading since the device was away
    bool released_ = false;
    glm::dvec3 rest_m_{0.0};  ///< the place it has kept near to,
    Instant since_{0};        ///< since when,
    std::uint8_t buttons_ = 0;
    Instant released_at_{0};
    DeadManCounters counters_{};
};

}  // namespace eddy
