#pragma once
#include "firmware/accuracy/sweep/table.h"
#include "firmware/gnuplot.h"

namespace eddy::accuracy::sweep {

/// Pictures of what the table holds points for:
///   work_B2.png, work_B3.png  error of the force against time: a curve for each method and grid, the front, real time
///   iterations.png            the same error against cycles or sweeps, and from where on more are waste
///   stages.png                where the time of a step goes, on each grid
///   viscosity.png             numerical viscosity against the grid
///   ripple.png                trembling of the force against time
std::vector<GnuplotPicture> pictures_of(const Table& table, const std::filesystem::path& folder);

}  // namespace eddy::accuracy::sweep
