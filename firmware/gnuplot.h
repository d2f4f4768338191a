#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace eddy {

/// Text in single quotes as gnuplot reads them.
std::string in_gnuplot_quotes(const std::string& text);

/// A PNG that gnuplot draws.
struct GnuplotPicture {
    std::filesystem::path file;
    int width_px, height_px;
    std::string commands;  ///< what comes after the terminal, the file and the style that all pictures share
};

/// Where the script of a picture lies: beside it.
std::filesystem::path script_of(const GnuplotPicture& picture);

/// Writes the script of each picture and runs it; a script can be run again from anywhere. Returns the pictures that were
/// drawn. If gnuplot is not installed, or failed, it says on standard error which were not and where their scripts are.
std::vector<std::filesystem::path> draw_with_gnuplot(const std::vector<GnuplotPicture>& pictures);

}  // namespace eddy
