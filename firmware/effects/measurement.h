#pragma once
#include <functional>

#include "firmware/effects/study.h"
#include "firmware/graphics.h"
#include "firmware/plan.h"
#include "firmware/stopwatch.h"

namespace eddy::effects {

/// What each variant of a scene costs.
struct EffectCosts {
    EffectStudy study;
    CostClock clock = CostClock::Wall;
    struct Variant {
        StepCost cost;
        Timings times;  ///< of whole steps, one a round
    };
    std::vector<Variant> variants;  ///< as in the study

    const Variant& with(const EffectAdded& added) const { return variants[added.with]; }
    const Variant& without(const EffectAdded& added) const { return variants[added.without]; }
};

using ShowProgress = std::function<void(double done, double total)>;

/// Plans every variant and warms all up, then lets all take a step in turn, round after round, so that a busy moment of the
/// machine falls on all alike. That keeps all of them in memory: scratch textures and programs are shared, but what a variant
/// goes on from is its own, six tenths of its textures. The 40 variants of `everything` hold 163 MB of textures on 32³ cells
/// and 521 MB on 48³ (the whole scene alone 11 and 34), in a process of 431 and 836 MB on llvmpipe.
EffectCosts measure(Graphics& graphics, EffectStudy study, int repeats, const ShowProgress& show);

/// Round by round, what a step with the effect took longer than one without.
std::vector<double> added_ms(const EffectCosts& costs, const EffectAdded& added, CostClock clock);

}  // namespace eddy::effects
