#pragma once
#include "firmware/gnuplot.h"
#include "firmware/stability/matrix.h"

namespace eddy::stability {

/// Cases with their numbers, what happens, what it provokes and what is wanted besides the rule.
std::string list_of(std::span<const Case> cases);

/// A line of the table on the terminal, and the line above all of them.
std::string table_head();
std::string table_line(const Result& result);
/// "118 of 120 cells are green", and how many were not tried.
std::string summary_of(std::span<const Cell> cells, std::span<const Result> results);

/// A page of Markdown about those cells; `results` may be of some of them only. `pictures` lie beside it.
std::string report_of(std::span<const Cell> cells, std::span<const Result> results,
                      const std::string& renderer, const std::string& machine,
                      const std::vector<std::filesystem::path>& pictures);

/// Rows: cases; columns: grids and efforts; colour: the kinetic energy ratio where it is green, and red.
GnuplotPicture heat_map_of(std::span<const Result> results, const std::filesystem::path& folder);

}  // namespace eddy::stability
