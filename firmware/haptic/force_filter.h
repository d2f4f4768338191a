#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "hal/clock.h"

namespace eddy {

/// The force smoothing of Yang, Lu, Safonova and Kuchenbecker 2009, section IV-D: a low-pass at the haptic
/// rate whose bandwidth follows the simulation's rate, and a limit on impulses.
struct ForceFilterSettings {
    double fraction_of_fluid_rate =
        0.25;                       ///< cut-off / fluid rate: leaves 0.5 % of a 1 Hz force as ripple at 50 Hz
    double lowest_cutoff_hz = 2.0;  ///< below this a hand's own motion (1-2 Hz) is filtered out of its force
    double highest_cutoff_hz =
        50.0;                ///< a faster fluid needs no smoothing that a hand could feel the lack of
    double impulse_n = 1.0;  ///< largest jump let in; at 50 Hz the force then moves at most 0.08 N a ms
};

/// First order on each axis, on purpose: its delay is the shortest for a given ripple floor (13 ms at 12.5
/// Hz; a second-order Butterworth takes 18), and delay is what lets a held drag force drive the hand. It
/// never overshoots, and its only state is its output, so changing the bandwidth while it runs cannot make a
/// jump.
class ForceFilter {
  public:
    ForceFilter() = default;
    explicit ForceFilter(const ForceFilterSettings& settings) : settings_(settings) {}

    /// One tick. A raw force that is not finite is handed on for the gate to judge and leaves no trace in
    /// here. `fluid_period` is the measured time between fluid updates; if it is not positive the lowest
    /// cut-off is used.
    glm::dvec3 operator()(const glm::dvec3& raw_n, Seconds fluid_period, Seconds dt);

    double cutoff_hz(Seconds fluid_period) const;
    /// Its lowest cut-off is not above its highest.
    bool is_sound() const { return settings_.lowest_cutoff_hz <= settings_.highest_cutoff_hz; }
    std::uint64_t impulses() const { return impulses_; }  ///< ticks whose raw force was limited

  private:
    ForceFilterSettings settings_{};
    glm::dvec3 filtered_n_{0.0};
    std::uint64_t impulses_ = 0;
};

}  // namespace eddy
