#pragma once
#include <functional>
#include <span>
#include <vector>

#include "firmware/accuracy/sweep/measure.h"

namespace eddy::accuracy::sweep {

using Chosen = std::vector<const Measurement*>;

/// Those for which `wanted` holds.
Chosen chosen(std::span<const Measurement> all, const std::function<bool(const Measurement&)>& wanted);

/// Those that none beats in time without being less exact: quickest first, each more exact than the one before.
Chosen front(const Chosen& some);

/// The quickest whose error is at most this; null if none is.
const Measurement* quickest_within(const Chosen& some, double error);

/// The most exact whose step takes at most so long; null if none does.
const Measurement* best_within(const Chosen& some, double wall_ms);

/// Of settings that differ only in their iterations, fewest first: the first from which on all the rest gains less than a tenth
/// of the error. What comes after it is waste. Null if there are less than two.
const Measurement* enough(const Chosen& by_iterations);

}  // namespace eddy::accuracy::sweep
