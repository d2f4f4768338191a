#pragma once
#include <string>

namespace eddy {

/// What every code means and looks like, as a table in markdown: that of docs/wiring.md.
std::string lamp_table();

}  // namespace eddy
