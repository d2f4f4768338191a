#pragma once
#include <filesystem>
#include <fstream>
#include <vector>

#include "gles/fluid/fluid.h"

namespace eddy {

/// series.csv: for each step, one row per body (or one with body "-" when the scene has none). The file
/// appears under its name only when it is complete. Force and torque are ON the body BY the fluid, Tank
/// frame; the body's place and motion are those at the end of the step.
class Series {
  public:
    /// Columns after those that every series has.
    struct More {
        std::vector<std::string> of_each_body{}, of_all{};
    };
    /// A value for each of them: a list for each body, and one that is the same in all their rows.
    struct MoreValues {
        std::vector<std::vector<double>> of_each_body{};
        std::vector<double> of_all{};
    };
    /// Throws std::runtime_error if the file cannot be written.
    Series(std::filesystem::path file, std::vector<std::string> bodies, const More& more);
    void add(double time_s, const gles::StepResult& result, const std::vector<gles::BodyState>& bodies,
             double step_ms, const MoreValues& more);
    /// Puts the file in its place. Throws std::runtime_error if the disk did not take it all.
    void finish();

  private:
    std::filesystem::path file_, beside_;
    std::vector<std::string> bodies_;
    std::ofstream out_;
};

}  // namespace eddy
