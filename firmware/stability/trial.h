#pragma once
#include <span>

#include "firmware/stability/case.h"
#include "firmware/stability/rule.h"

namespace eddy::stability {

/// What became of a case, or of two at once, on one grid at one effort.
struct Outcome {
    long steps = 0;  ///< taken; fewer than planned after a failure
    Verdict verdict = {};
    std::string remark = {};  ///< what the case has to say of itself; of one alone
    double wall_s = 0.0;
};

/// Two at once take no more. What single cases want cannot be wanted of both at once: then only the rule is judged.
inline constexpr long kStepsOfPair = 200;

struct Plan {
    long steps = 0;
    double calm_s = 0.0;  ///< at the end; less than kCalmS is not judged (rule.h)
};
/// Of cases at once that want no more than so many steps.
Plan plan_of(std::span<const Case* const> cases, const Trial& trial, long most_steps);

/// Tries it, for at most `most_steps`.
Outcome try_out(gles::Gpu& gpu, std::span<const Case* const> cases, const Trial& trial, long most_steps);

}  // namespace eddy::stability
