#pragma once
#include <filesystem>
#include <vector>

#include "firmware/accuracy/sweep/table.h"

namespace eddy::accuracy::sweep {

/// Draws what the table holds points for, by gnuplot, each picture beside the script that made it:
///   work_B2.png, work_B3.png  error of the force against time: a curve for each method and grid, the front, real time
///   iterations.png            the same error against cycles or sweeps, and from where on more are waste
///   stages.png                where the time of a step goes, on each grid
///   viscosity.png             numerical viscosity against the grid
///   ripple.png                trembling of the force against time
/// Returns the pictures it made; says on standard error what is missing and why.
std::vector<std::filesystem::path> plot(const Table& table, const std::filesystem::path& folder);

}  // namespace eddy::accuracy::sweep
