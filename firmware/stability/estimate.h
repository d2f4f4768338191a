#pragma once
#include <functional>
#include <string>
#include <vector>

#include "firmware/stability/matrix.h"

namespace eddy::stability {

/// How long cells will take, from a few steps of the common scene on each of their grids at each effort: cases with more in
/// the tank take longer. To make it takes some seconds on large grids.
class Estimate {
  public:
    Estimate(gles::Gpu& gpu, std::span<const Cell> cells);

    double seconds(const Cell& cell) const;
    /// "about 2 h 10 min: 8^3 11 min, 25^3 1 h 59 min"
    std::string in_words(std::span<const Cell> cells) const;

  private:
    struct Pace {
        Trial trial;
        double start_s, step_s;
    };
    std::vector<Pace> paces_;
};

}  // namespace eddy::stability
