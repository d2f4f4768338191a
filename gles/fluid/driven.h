#pragma once
#include <vector>

#include "gles/fluid/setup.h"

namespace eddy::gles {

/// How fast what drives the fluid has lately been: bodies, jets, the flow it started with. Vorticity confinement pushes no
/// fluid that is much faster, or it would feed an eddy for ever. "Lately" is a few crossings of the tank at that speed.
/// Infinite where moving walls, weight or a force drive the fluid, whose speed is not known beforehand.
class Driven {
  public:
    explicit Driven(const FluidSetup& setup);

    /// From now on the fluid moves as fast as that.
    void start(double speed_m_s) { speed_m_s_ = speed_m_s; }
    /// After dt_s in which the bodies got to these states; `time_s`: when that began.
    void go_on(const std::vector<BodyState>& bodies, double time_s, double dt_s);
    double speed_m_s() const;

  private:
    const FluidSetup* setup_;
    bool unknown_;
    double speed_m_s_ = 0.0;
};

}  // namespace eddy::gles
