#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

#include "hal/clock.h"

namespace eddy {

/// Why the gate lets through what it does. The later, the graver; the last two stay until reset.
enum class GateReason {
    Open,
    Starting,
    FluidStale,
    DeviceUnsure,
    TooFast,
    Released,
    Disabled,
    Stopped,
    DeviceNotReady,
    DeviceSilent,
    NotFinite
};

struct GateSentence {
    GateReason reason;
    std::string_view word;  ///< for tables (force.csv)
    std::string_view sentence;
};
inline constexpr std::array<GateSentence, 11> kGateSentences{{
    {GateReason::Open, "open", "the force reaches the hand"},
    {GateReason::Starting, "starting", "the force is being brought in gently"},
    {GateReason::FluidStale, "fluid_stale", "the fluid has not answered in time: the force fades out"},
    {GateReason::DeviceUnsure, "device_unsure",
     "the device was not sure where the handle is: its force comes back in a moment"},
    {GateReason::TooFast, "too_fast", "the handle moves faster than a hand should: no force"},
    {GateReason::Released, "released", "nobody seems to hold the handle: no force"},
    {GateReason::Disabled, "disabled", "force is switched off"},
    {GateReason::Stopped, "stopped",
     "the stop input was pressed, or could not be looked at: no force until somebody restarts it"},
    {GateReason::DeviceNotReady, "device_not_ready", "the device is not ready: no force"},
    {GateReason::DeviceSilent, "device_silent", "the device stopped answering: no force until reset"},
    {GateReason::NotFinite, "not_finite", "a number was not finite: no force until reset"},
}};
constexpr std::string_view to_string(GateReason reason) {
    return kGateSentences[static_cast<std::size_t>(reason)].sentence;
}
constexpr std::string_view to_word(GateReason reason) {
    return kGateSentences[static_cast<std::size_t>(reason)].word;
}

/// CHAI3D drives the Falcon with at most 8 N (CDeltaDevices.cpp); no setting goes above.
inline constexpr double kDeviceMaxForceN = 8.0;
/// A handle faster than this has slipped or been thrown.
inline constexpr double kFastestHandMS = 1.0;
inline constexpr Seconds kSoftStart{1.0};
inline constexpr Seconds kFade{0.040};  ///< of a force that nobody computes any more (law.h)
/// A fluid that was stale for no longer than this was late, not dead (a picture that took 100 ms): its force fades as any does,
/// and is back where it was so soon. Over kSoftStart a machine that is late twice a second would never have it whole. The same
/// for a device that missed a reply.
inline constexpr Seconds kHiccup{0.100}, kQuickReturn{0.150};
/// Motors hold the last force while a tick is late; the first tick after must not spend the whole gap in one
/// step.
inline constexpr Seconds kLongestRise{0.005};

struct GateLimits {
    double max_force_n = kDeviceMaxForceN;
    double slew_n_per_s = 100.0;  ///< 0.1 N a tick: a step above that is felt as a tap
};

struct GateInput {
    glm::dvec3 force_n{0.0};           ///< wanted on the hand, Device frame
    double most_n = kDeviceMaxForceN;  ///< for now; GateLimits::max_force_n holds besides
    double speed_m_s = 0.0;            ///< of the handle; not finite if the reading was not
    bool enabled = false;              ///< dead man's switch: held, running and allowed, said anew each tick
    bool device_ready = false;         ///< Ready and has answered
    bool device_silent = false;        ///< reply missing too long; latches
    bool device_unsure = false;        ///< it sends zero whatever it is told
    bool fluid_stale = true;           ///< fluid force too old to be believed
    bool reset = false;                ///< forget the latch; it closes again at once if its cause persists
};

struct GateCounters {
    std::uint64_t clamped = 0;     ///< ticks with a force above max_force_n
    std::uint64_t slewed = 0;      ///< ticks held back by the slew limit
    std::uint64_t non_finite = 0;  ///< ticks with a force or speed that was not finite
};

/// The only way to the motors. What comes out is finite, no longer than max_force_n, and moves no faster than
/// slew_n_per_s except towards zero: at once for a fault, in at most kFade for a stale fluid. After any zero
/// it returns over kSoftStart, after a hiccup of the fluid or of the device over kQuickReturn.
class ForceGate {
  public:
    ForceGate() = default;
    explicit ForceGate(const GateLimits& limits);

    glm::dvec3 operator()(const GateInput& in, Seconds dt);

    GateReason reason() const { return reason_; }  ///< of the last tick
    const GateCounters& counters() const { return counters_; }
    /// Its bytes are a state that it can be in (sound.h).
    bool is_sound() const;

  private:
    GateReason judge(const GateInput& in);
    void hiccup(bool begins, Seconds dt);
    glm::dvec3 fade(Seconds dt);
    glm::dvec3 follow(const GateInput& in, Seconds dt);

    GateLimits limits_{};
    GateReason latch_ = GateReason::Open;  // DeviceSilent or NotFinite once seen
    GateReason reason_ = GateReason::Disabled;
    double strength_ = 0.0;  // 0 shut .. 1 open: rises over kSoftStart or kQuickReturn, falls over kFade
    double had_ = 0.0;       // before a hiccup took it
    Seconds hiccup_for_{0.0};
    glm::dvec3 sent_n_{0.0};  // last tick's output
    GateCounters counters_{};
};

}  // namespace eddy
