#pragma once
#include <optional>
#include <vector>

#include "firmware/accuracy/case.h"
#include "firmware/scene_grid.h"

namespace eddy::accuracy {

enum class Verdict {
    Unjudged,  ///< no limit is set for it
    Met,
    Missed
};

/// A quantity on a grid.
struct Reading {
    double measured = 0.0;
    double error = 0.0;                ///< as Quantity::error says
    std::optional<double> order = {};  ///< from the next coarser grid to this one
    std::optional<double> limit = {};  ///< of the error
    std::optional<double> least_order = {};
    Verdict verdict = Verdict::Unjudged;
    std::optional<bool> covers = {};  ///< an estimate: whether it is as large as the error it is of
};

/// A case on a grid.
struct Row {
    glm::ivec3 cells{0};
    double cell_m = 0.0;
    double dt_s = 0.0;
    long steps = 0;        ///< of all runs of the scene together
    double step_ms = 0.0;  ///< median wall time of a step
    double total_s = 0.0;
    std::vector<Reading> readings = {};  ///< in the order of the case's quantities
};

struct Study {
    const Case* of = nullptr;
    std::vector<Row> rows;  ///< coarsest first
};

/// The case's scene with so many cells along its longest side, and the time step that goes with them: as near to the
/// rule as a whole number of steps in each of its parts allows. Throws InputError, as with_longest_side(), if the grid does not
/// fit the tank.
Scene scene_on_grid(const Case& one, int cells, std::string_view asked_by = kAnyGrid);

/// The error of a measured value.
double error_of(const Quantity& quantity, double measured);

/// The limit that holds on a grid, if one does.
std::optional<double> limit_on(const Quantity& quantity, int cells);

/// Judges every reading of rows that hold only what was measured; rows are coarsest first.
void judge(const Case& one, std::vector<Row>& rows);

/// Runs the case on each of these grids.
Study study(gles::Gpu& gpu, const Case& one, std::vector<int> grids);

/// Whether any reading missed its limit.
bool missed(const Study& study);

}  // namespace eddy::accuracy
