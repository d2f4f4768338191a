#pragma once
#include <functional>
#include <optional>
#include <string>

#include "firmware/stability/history.h"

namespace eddy::stability {

// What single cases want besides the rule. Each gives a criterion that says in words what is wrong, or nothing.
using Criterion = std::function<std::optional<std::string>(const History&)>;

/// After these an impulsive start is over.
inline constexpr long kSettlingSteps = 10;

/// Of shorter runs nobody can say whether something levels off: nothing is said of it (Case::least_steps).
inline constexpr long kLevelSteps = 400;

/// |p| <= 100 rho (U^2 + U L / dt): a hundred times what it takes to bring the tank to the speed U in a step.
Criterion pressure_bounded(double speed_m_s);
/// The largest |p| of the last quarter is at most 1.5 times that of the quarter before.
Criterion pressure_levels_off();
/// Or it is less than ten times what it takes to set the tank going at that speed in a step, and may still grow.
Criterion pressure_levels_off_or_is_small(double speed_m_s);
/// The same of kinetic energy, at most 1.1 times.
Criterion energy_levels_off();
/// Or it is less than a tenth of that of the tank at the speed of the fastest body, and may still grow.
Criterion energy_levels_off_or_is_small();
/// Kinetic energy is never more than 0.1 % above what it was at any look before.
Criterion energy_never_rises();
/// The fastest speed is never more than 0.1 % above that at the start.
Criterion speed_never_rises();
/// speed <= 1.5 sqrt(2 g' L), g' being what heat in the tank makes of gravity; `expansion_1_k`: lighter by a kelvin.
Criterion no_faster_than_a_fall(double expansion_1_k);
/// Bodies do no negative work in all: the fluid gives back no more than it got.
Criterion gives_back_no_more();
/// What flows in through the walls flows out, but for this share of the most that ever flowed in.
Criterion volume_balances(double share);
/// From one step to the next the force on body `i` changes by less than this share of its peak, after the first `settling`.
Criterion force_is_continuous(std::size_t i, double share, long settling);
/// While the fluid does not answer, the force on the hand is 0 so long after the first missing answer was due: a step after the last.
Criterion hand_let_go(double within_s);
/// This many seconds after the last disturbance the force is down to 2 % of its peak.
Criterion force_recovers(double within_s);
/// After each reset forces are the same, bit for bit.
Criterion same_after_each_reset();
/// No force from a body that is not in the tank.
Criterion no_force_outside();
/// On its way back in through a wall, up to a diameter behind it, the force on the ball changes from step to step by no more
/// than it would if all of it came and went within half a diameter.
Criterion returns_smoothly();
/// What bodies together feel is what pressure and friction took from the momentum of the fluid around them, but for this share
/// of the peak (validation B8.2; gles/fluid/force_methods.h). For scenes that ask for force_methods, without gravity.
Criterion forces_balance(double share);
/// What a fault after step `at` changes of the force on body 0, beside that of the common scene, is down to a tenth, or to
/// rounding, `within` steps.
Criterion is_forgotten(std::size_t at, std::size_t within);
/// Forces on body 0 are those of the common scene times this, but for a share of the peak.
Criterion same_as_common(double factor, double share);
/// Energy is down to a tenth by this step.
Criterion energy_decays(long by_step);
/// After each fault no texel is left that is not finite; loads are finite all the time.
Criterion loads_stay_finite();
/// A step of no time gives the force of the step before it.
Criterion no_time_no_news();
/// Beside the line of this frequency and its multiples no line of the force on body 0 is higher than 5 % of it.
Criterion no_other_lines(double frequency_hz);
/// All of these.
Criterion all_of(std::vector<Criterion> criteria);

// Figures that are of interest, good or bad, in words (Case::remark).
using Remark = std::function<std::string(const History&)>;

/// What forces_balance() looks at.
Remark remark_on_balance();
/// What same_as_common() looks at.
Remark remark_on_common(double factor);
/// How much longer a step takes in the last fifth than in the first.
Remark remark_on_time();
/// Kinetic energy at the end, to that at the start.
Remark remark_on_energy();

}  // namespace eddy::stability
