#pragma once
#include <optional>
#include <vector>

#include "firmware/haptic_study/metrics.h"
#include "firmware/haptic_study/rig.h"

namespace eddy::haptic_study {

// What is tried with one fluid at one rate under one law. Each wants a fluid that has just been made.

/// The hand on a circle of 20 mm once a second, then a rest, then off at 0.1 m/s.
struct CircleFigures {
    double roughness =
        0.0;  ///< of what is felt less the reference, 10 .. 400 Hz, as a share of the reference
    double trembling = 0.0;               ///< the same of what is felt alone, as a share of itself
    double reference_trembling = 0.0;     ///< and of the reference alone
    double rmse = 0.0;                    ///< of what is felt less the reference, as a share of the reference
    double lag_s = 0.0;                   ///< of the 1 Hz part behind that of the reference
    std::optional<double> half_rise_s{};  ///< from setting off to half of what that changes
    double force_n = 0.0;                 ///< rms of the reference, on the hand
    double damped = 0.0;                  ///< share of the ticks in which energy was taken out
    ForceReport report{};
    double stored_j = 0.0;  ///< the most kinetic energy the fluid was seen to have, as the hand would feel it
    std::vector<glm::dvec3> felt{}, reference{};  ///< [N] a millisecond each
};

/// The force on the body at each millisecond of the circle [N, before gain]: of a fluid that takes a step in every one, knows where
/// the body really is, and answers at once.
std::vector<glm::dvec3> reference_forces(StudyFluid& fluid);
CircleFigures circle_figures(StudyFluid& fluid, ForceLaw law, double rate_hz,
                             const std::vector<glm::dvec3>& reference);

inline constexpr double kStirsHz[] = {0.5, 1.0, 2.0, 5.0};

/// The hand on the circle at some frequency.
struct StirFigures {
    double least_cycle_j = 0.0;  ///< what the cheapest cycle costs the hand
    double mean_cycle_j = 0.0;
    double received_j = 0.0;  ///< what the fluid received in a cycle by its own books
    double drag_j = 0.0;  ///< what a drag takes that received so much of a hand which it sees at its own rate
};
StirFigures stir_figures(StudyFluid& fluid, ForceLaw law, double rate_hz, double stir_hz);

/// How far the mean of what an arm feels over a second in the middle of the tank is from what the fluid gives after gain, as a share
/// of that.
double pull_error(StudyFluid& fluid, double rate_hz);

/// An arm that lets go does so out of a circle of so many turns a second: at 0.1 to 0.3 m/s.
inline constexpr double kLetGoHz[] = {1.0, 2.0, 3.0, 5.0};

/// What the hand does and feels while it comes to rest: it has leapt by 20 mm, two seconds and a half before the end, or let the
/// handle go, 5.6 s before, out of a circle at `stir_hz`.
std::vector<Felt> coming_to_rest(StudyFluid& fluid, ForceLaw law, double rate_hz, Holder holder,
                                 double stir_hz = 1.0);
/// What a handle feels that cannot move, where another came to rest in the end; for as long as the loop takes it for held.
std::vector<Felt> fixed_there(StudyFluid& fluid, ForceLaw law, double rate_hz, std::span<const Felt> rested);
/// What of that still swings in its last second.
Swing swing_figures(std::span<const Felt> ticks);
/// What the flow by itself makes of a handle held so: the force that a handle felt which cannot move, less its mean, on
/// one that can. A loop that drives itself swings more than this.
Swing carried_figures(std::span<const Felt> fixed, Holder holder);

}  // namespace eddy::haptic_study
