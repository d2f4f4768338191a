#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "firmware/stability/long_run.h"

namespace eddy::stability {

/// The file of long runs in a folder of reports.
inline constexpr const char* kLongRunsCsv = "endless.csv";

struct LongRun {
    std::string what;  ///< scene, grid, who was there, when
    std::vector<LongRunSample> samples;
};

/// Lines for a terminal.
std::string table_of(std::span<const LongRunSample> samples);
/// A line for each sample, with `what` in front.
std::string csv_of(std::span<const LongRun> runs);
/// What csv_of() wrote; `file` is what complaints call it. Throws InputError.
std::vector<LongRun> long_runs_from_csv(const std::string& text, const std::filesystem::path& file);
/// A section of Markdown: of each run some samples, and what drifted.
std::string report_of(std::span<const LongRun> runs);

}  // namespace eddy::stability
