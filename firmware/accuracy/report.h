#pragma once
#include <span>
#include <string>

#include "firmware/accuracy/study.h"

namespace eddy::accuracy {

// What studies look like on a terminal and in files.

/// One line for each case: name, grids, title.
std::string list_of(std::span<const Case> cases);

/// The table of one case: what it measured on each grid, beside what it should be, and what that cost.
std::string table_of(const Study& study);

/// One line for each quantity, on its finest grid.
std::string summary_of(std::span<const Study> studies);

/// One line for each quantity on each grid; times in s and ms, errors as shares of 1.
std::string csv_header();
std::string csv_of(const Study& study);

/// Everything, with what it ran on.
std::string json_of(std::span<const Study> studies, const gles::Capabilities& driver);

}  // namespace eddy::accuracy
