#include <array>
#include <limits>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"

namespace eddy::stability {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr std::array kNone{std::numeric_limits<float>::quiet_NaN(), kInf, -kInf, 1e30f};

/// 23: every 20 steps one texel holds nan, infinity, minus infinity or 1e30, in turn, for as long as the hand stirs.
Case struck(const char* name, const char* title, Fault::Place place) {
    return {
        .number = 23,
        .name = name,
        .title = title,
        .provokes = "nan spreads a cell a sweep: the whole tank in a step",
        .wants = "no load is other than finite",
        .change =
            [place](Scene& s) {
                if (place == Fault::Place::Temperature) s.temperature.emplace().expansion_1_k = 0.0034;
            },
        .script =
            [place](Moment& m) {
                if (m.disturbs() && m.step % 20 == 19)
                    m.faults.push_back({place, kNone[static_cast<std::size_t>(m.step / 20) % kNone.size()]});
            },
        .complaint = loads_stay_finite(),
        .least_steps = 160,
        .puts_faults = true,
        .pardon_steps = 5};
}

/// The hand's path begins again with each reset.
void stroke_since_reset(Moment& moment, long steps_between) {
    Moment since = moment;
    since.time_s = moment.scene->solver.dt_s * static_cast<double>(moment.step % steps_between);
    moment.hand_m = stroke_m(since);
}

}  // namespace

std::vector<Case> fault_cases() {
    std::vector<Case> cases;
    cases.push_back(struck("nan-in-velocity", "a texel of the velocity is struck", Fault::Place::Velocity));
    cases.push_back(struck("nan-in-pressure", "a texel of the pressure is struck", Fault::Place::Pressure));
    cases.push_back(struck("nan-in-smoke", "a texel of the smoke is struck", Fault::Place::Smoke));
    cases.push_back(struck("nan-in-heat", "a texel of the temperature is struck", Fault::Place::Temperature));
    cases.push_back(
        struck("nan-in-solid", "a texel of the solids' shares is struck", Fault::Place::Fractions));
    cases.push_back(struck("nan-under-a-hand", "a texel of the velocity is struck while a hand feels the fluid",
                           Fault::Place::Velocity));
    cases.back().drive = Drive::Hand;
    cases.back().wants = "no load is other than finite, and the hand gets the last good force";
    cases.push_back({.number = 24,
                     .name = "garbage-reset",
                     .title = "all textures hold garbage, then nan, and the fluid is reset",
                     .provokes = "stale data outlive the reset",
                     .wants = "after the reset forces are those after the start, bit for bit",
                     .script =
                         [](Moment& m) {
                             stroke_since_reset(m, 50);
                             if (m.step == 0 || m.step % 50 != 0) return;
                             m.reset = true;
                             const bool nan = m.step % 100 == 0;
                             for (const Fault::Place place :
                                  {Fault::Place::Velocity, Fault::Place::Pressure, Fault::Place::Smoke})
                                 m.faults.push_back(
                                     {place, nan ? kNone[0] : 1e6f,
                                      nan ? Fault::Extent::Everywhere : Fault::Extent::Garbage});
                         },
                     .complaint = same_after_each_reset(),
                     .least_steps = 120,
                     .calm_share = 0.0,
                     .puts_faults = true});
    cases.push_back({.number = 24,
                     .name = "preset-changes",
                     .title = "the preset changes every ten steps between fast and precise",
                     .provokes = "fields that are resized or copied while they are used",
                     .drive = Drive::Hand,
                     .script = [](Moment& m) { m.change_preset = m.step % 10 == 9; }});
    cases.push_back({.number = 25,
                     .name = "resets",
                     .title = "a thousand resets with the ball moving",
                     .provokes = "leaks, and a warm start from before the reset",
                     .wants = "after each reset forces are those after the start, bit for bit",
                     .script =
                         [](Moment& m) {
                             stroke_since_reset(m, 5);
                             m.reset = m.step > 0 && m.step % 5 == 0;
                         },
                     .complaint = same_after_each_reset(),
                     .steps = 5000,
                     .calm_share = 0.0,
                     .small_only = true});
    return cases;
}

}  // namespace eddy::stability
