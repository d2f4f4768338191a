#pragma once
#include <filesystem>
#include <optional>

namespace eddy {

/// Draws the hand's path with the force sent to it as arrows, as figure 7 of Yang et al. 2009, from a
/// force.csv into motion.png beside it, by gnuplot. Leaves the gnuplot script there too. Returns the picture,
/// or nothing if gnuplot is not installed or failed (it says so on standard error).
std::optional<std::filesystem::path> plot_forces(const std::filesystem::path& force_csv);

}  // namespace eddy
