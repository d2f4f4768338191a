#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/gnuplot.h"
#include "firmware/haptic_study/study.h"

namespace eddy::haptic_study {

/// One thing that was to be reached: how far, and whether.
struct Goal {
    std::string what;
    std::string found;
    bool reached;
};
std::vector<Goal> goals_of(const Study& study);

/// A table of what was found, with the goals at its end.
std::string summary_of(const Study& study);
/// The page, for a reader.
std::string report_of(const Study& study, const StudyOrder& order, const std::string& machine,
                      const std::vector<std::filesystem::path>& pictures);
/// A line for each number: fluid, trial, law, rate_hz, of, value.
std::string csv_of(const Study& study);
std::vector<GnuplotPicture> pictures_of(const Study& study, const std::filesystem::path& folder);

}  // namespace eddy::haptic_study
