#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gles/fluid/setup.h"

namespace eddy::gles {

// What a step is given comes from a hand, a recording, a config file or a driver, and may be anything. These guards make
// of it a step that can be computed, and count how often they had to.

/// How often each guard acted since the fluid was made. status.json has them under the same names.
struct GuardCounts {
    long step_refused = 0;     ///< no length, hardly any, or none that is a number: no time passed
    long step_shortened = 0;   ///< longer than any this fluid is made for
    long body_not_finite = 0;  ///< stayed where it was, at rest
    long body_not_unit = 0;    ///< its orientation was brought to unit length
    long body_far = 0;         ///< drawn in to within its own size of the tank
    long body_too_fast = 0;    ///< slowed down to kBodyLengths
    long unsound_steps = 0;    ///< found something in the fluid, or gave a load, that cannot be

    GuardCounts& operator+=(const GuardCounts& other);
};

/// A body moves, and its surface turns, at most this many of the tank's longest sides in a step: nothing faster is resolved
/// in any way.
inline constexpr double kBodyLengths = 1.0;
/// The same of the fluid, which jets may drive across the tank several times a step. What is faster is no flow.
inline constexpr double kFluidLengths = 10.0;

/// Above these, values that live from step to step are no values of a flow; the shaders make 0 of them (guard.glsl).
struct Sound {
    float fastest_m_s;  ///< of the fluid
    /// The same between friction and pressure: each holds the other there, and thick fluid is pushed harder than it moves. For the
    /// count of faults alone; a guess beyond fastest_m_s is none.
    float most_diffused_m_s;
    /// Of dt p / (rho h) [m/s]; of what is a pressure, a sixteenth is kept whole for the next step.
    float most_phi;
};
Sound sound(const FluidSetup& setup, double dt_s);
/// Of a body's centre; of its surface, by turning.
double fastest_body_m_s(const FluidSetup& setup, double dt_s);
/// Neither moves nor turns faster than that afterwards; whether it did.
bool slow_down(BodyState& body, const Shape& shape, double fastest_m_s);
/// FARTHEST: as many cells as the fluid goes at that speed in a step, for shaders that carry something with it.
std::pair<std::string, std::string> farthest(const FluidSetup& setup);

/// How long the step is to be; nothing: no step.
std::optional<double> guarded_step_s(double dt_s, const FluidSetup& setup, GuardCounts& counts);

/// The bodies as the step may have them at its end. `before`: at the end of the last step, empty before the first.
std::vector<BodyState> guarded_bodies(std::vector<BodyState> given, const std::vector<BodyState>& before,
                                      const FluidSetup& setup, double dt_s, GuardCounts& counts);

/// Whether every number of it is one.
bool is_finite(const BodyState& state);
bool is_finite(const Load& load);

}  // namespace eddy::gles
