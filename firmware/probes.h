#pragma once
#include <string>
#include <vector>

#include "config/scene.h"
#include "gles/fluid/fluid.h"

namespace eddy {

/// What a scene's probes measure, as columns of series.csv. A value is linear between the places where the solver
/// keeps the quantity, and beyond the outermost of them up to the walls: a field that is linear is read exactly.
class Probes {
  public:
    explicit Probes(const Scene& scene);

    /// "wake_velocity_x_m_s"; along a line "wake_1_velocity_x_m_s" and so on.
    std::vector<std::string> columns() const;
    /// A value for each column. Waits for the GPU.
    std::vector<double> read(const gles::Fluid& fluid) const;

  private:
    bool any(ProbeQuantity quantity) const;

    std::vector<Scene::Probe> probes_;
    glm::ivec3 cells_;
    double cell_m_;
};

}  // namespace eddy
