#pragma once
#include <filesystem>
#include <span>

#include "firmware/stability/trial.h"

namespace eddy::stability {

enum class Extent {
    Quick,  ///< as few steps as do on 8^3 cells, and a handful of pairs: some minutes
    Usual,  ///< all cases but the longest, to their end, on 8^3 and 25^3 cells
    Full    ///< everything, on four grids, and every pair
};

/// What the user asked for.
struct Order {
    Extent extent = Extent::Usual;
    std::vector<std::string> cases = {};  ///< names or numbers; "a+b": both at once; none: all
    std::vector<std::string> grids = {};  ///< none: those of the extent
};

/// One cell of the matrix.
struct Cell {
    std::vector<const Case*> cases;  ///< one, or two at once
    Trial trial;
    long most_steps;
    /// "stall", "stall+corner"
    std::string name() const;
    /// In which what the case wants is judged.
    long steps() const;
    /// With the calm after those.
    long all_steps() const;
};

/// All cells, row by row. Throws InputError for cases and grids that do not exist.
std::vector<Cell> cells_of(const Order& order);

/// A cell that has been tried.
struct Result {
    int number = 0;  ///< of the case; of a pair, of its first
    std::string name = {};
    std::string grid = {};
    std::string effort = {};
    Outcome outcome = {};
    std::string tried = {};  ///< when, and by what: "2026-11-22 16:53, v0.1.0-3-g1a2b3c4" (built_from.h)
    bool is_of(const Cell& cell) const;
    /// It is of that cell; and if green, for as long as that is.
    bool counts_for(const Cell& cell) const;
};
/// Tried now, by this program.
Result result_of(const Cell& cell, const Outcome& outcome);
/// The result that counts for a cell, or none.
const Result* find(std::span<const Result> results, const Cell& cell);

/// In which order cells are best tried, as indices: single cases before pairs, of these small grids first, and on each those first
/// that were red on a smaller grid, or before.
std::vector<std::size_t> telling_first(std::span<const Cell> cells, std::span<const Result> known);

/// case, name, grid, effort, steps, pass, reason, kinetic energy ratio, largest force, recovery time, non-finite texels, wall
/// time, remark, when and by what: a line for each result, after a line of names.
std::string csv_of(std::span<const Result> results);
/// What csv_of() wrote; `file` is what complaints call it. Throws InputError.
std::vector<Result> results_from_csv(const std::string& text, const std::filesystem::path& file);

/// Results of parts of one matrix, in the order of its cells; of a cell that is in several parts, that of the last.
std::vector<Result> merged(std::span<const Cell> cells, std::span<const std::vector<Result>> parts);

}  // namespace eddy::stability
