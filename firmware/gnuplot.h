#pragma once
#include <filesystem>
#include <string>

namespace eddy {

/// Text in single quotes as gnuplot reads them.
std::string in_gnuplot_quotes(const std::string& text);

/// Runs a script. False if gnuplot is not installed or failed: it says so on standard error, what there is no plot of, and
/// where the script is.
bool run_gnuplot(const std::filesystem::path& script, const std::string& plot_of);

}  // namespace eddy
