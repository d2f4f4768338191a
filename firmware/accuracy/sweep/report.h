#pragma once
#include <string>

#include "firmware/accuracy/sweep/table.h"

namespace eddy::accuracy::sweep {

/// The yardstick: on this grid, the most that the paper's method attains, and what the usual setting of `fast` costs.
struct Yardstick {
    const Measurement* fast;
    const Measurement* yang2009;  ///< at its least error with up to 160 sweeps
};
/// On 64 cells where they were measured, else on the finest grid that both were measured on; null if there is none.
std::optional<Yardstick> yardstick(const Table& table);

/// What accuracy costs: time per step to reach each threshold, for each method; what real time buys; from where on more
/// iterations are waste; what is not in it.
std::string report_of(const Table& table);

}  // namespace eddy::accuracy::sweep
