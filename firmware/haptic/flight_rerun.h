#pragma once
#include <optional>
#include <vector>

#include "firmware/haptic/flight.h"

namespace eddy {

/// A flight run again, tick by tick at the times it had.
struct Rerun {
    std::vector<LawOutput> outputs;
    std::size_t differing = 0;         ///< ticks of which a bit is different
    std::optional<std::size_t> first;  ///< of these
    double most_n = 0.0;               ///< by so much a force differs at most
};
Rerun rerun(const Flight& flight);

}  // namespace eddy
