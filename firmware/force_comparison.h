#pragma once
#include <optional>
#include <string>
#include <vector>

#include "gles/fluid/fluid.h"

namespace eddy {

/// The force on the bodies measured three ways (gles/fluid/force_methods.h): as columns of series.csv, and how well the three
/// agreed over a whole run.
class ForceComparison {
  public:
    explicit ForceComparison(std::size_t bodies) : sums_(bodies) {}

    /// "force_box_x_n" and so on, then what transport made or lost around the body.
    static std::vector<std::string> columns();
    /// A value for each column.
    static std::vector<double> values(const gles::ForceMethods& methods);

    /// Of one step, body by body.
    void add(const std::vector<gles::Load>& loads, const std::vector<gles::ForceMethods>& methods);
    /// Of one body: rms over the steps of the largest difference between two of the three, over the rms force. None if there
    /// was never any force, as on a body whose force is not measured.
    std::optional<double> spread(std::size_t body) const;
    /// Rms of what transport made or lost, over the rms force.
    std::optional<double> transport(std::size_t body) const;

  private:
    struct Sums {
        double force = 0.0, spread = 0.0, transport = 0.0;  ///< of squares [N^2]
    };
    std::vector<Sums> sums_;
};

}  // namespace eddy
