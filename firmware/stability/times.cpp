#include <array>
#include <cmath>
#include <limits>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"

namespace eddy::stability {
namespace {

/// A number from 0 to 1 that only hangs on the step: a fraction of the golden ratio's multiples.
double spread(long step) {
    const double turns = 0.6180339887498949 * static_cast<double>(step);
    return turns - std::floor(turns);
}

void take(Moment& moment, double dt_s) {
    moment.dt_s = dt_s;
    moment.hand_m = stroke_m(moment);
}

/// In place of every tenth step, one of these.
template <std::size_t N>
std::function<void(Moment&)> odd_steps(const std::array<double, N>& dt_s) {
    return [dt_s](Moment& moment) {
        const auto tenth = static_cast<std::size_t>(moment.step / 10);
        if (moment.step % 10 != 9) return;
        moment.dt_s = dt_s[tenth % N];
        if (moment.dt_s > 0.0 && moment.dt_s < 1.0) moment.hand_m = stroke_m(moment);
    };
}

}  // namespace

std::vector<Case> time_cases() {
    std::vector<Case> cases;
    cases.push_back({.number = 2,
                     .name = "stall",
                     .title = "the machine stalls for 250 ms every 2 s while the hand moves on",
                     .provokes = "one long step: an impulse in the force",
                     .drive = Drive::Hand,
                     .script = [](Moment& m) { take(m, m.step % 88 == 87 ? 0.25 : m.dt_s); },
                     .least_steps = 100});
    cases.push_back(
        {.number = 2,
         .name = "jitter",
         .title = "steps last from a fifth to five times their usual time",
         .provokes = "a guess of the pressure that is wrong by a factor, and impulses in the force",
         .drive = Drive::Hand,
         .script = [](Moment& m) { take(m, m.dt_s * std::pow(5.0, 2.0 * spread(m.step) - 1.0)); }});
    cases.push_back({.number = 3,
                     .name = "dt-0",
                     .title = "some steps last 0, 1e-9 or 1e-7 s",
                     .provokes = "the force is an impulse over dt: rounding, or 0 by 0",
                     .wants = "such a step gives the force of the step before it",
                     .drive = Drive::Steps,
                     .script = odd_steps(std::array{0.0, 1e-7, 1e-9}),
                     .complaint = no_time_no_news(),
                     .steps = 700});  // a tenth of them take no time, and calm takes 5 s
    cases.push_back(
        {.number = 3,
         .name = "dt-short",
         .title = "some steps last a five-hundredth, a fiftieth or a fifth of their usual time",
         .provokes = "a change of the hand's velocity within next to no time: its added mass over dt",
         .drive = Drive::Hand,
         .script = odd_steps(std::array{4e-5, 4e-4, 4e-3}),
         .steps = 700});
    cases.push_back(
        {.number = 3,
         .name = "dt-nonsense",
         .title = "some steps last -20 ms, a quarter of an hour, or not a number",
         .provokes = "a clock that was set, a driver that gives nonsense: nan everywhere in one step",
         .drive = Drive::Steps,
         .script = odd_steps(std::array{-0.02, 900.0, std::numeric_limits<double>::quiet_NaN()}),
         .calm_share = 0.0});
    return cases;
}

}  // namespace eddy::stability
