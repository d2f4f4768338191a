#pragma once
#include <vector>

#include "gles/fluid/setup.h"

namespace eddy::gles {

/// How fast what drives the fluid has been: bodies, jets, walls, the flow it started with. "Lately" is a few crossings of the
/// tank at that speed. Where weight or a force drives the fluid, or bodies that it moves itself, nobody knows beforehand.
class Driven {
  public:
    explicit Driven(const FluidSetup& setup);

    /// From now on the fluid moves as fast as that, and nothing else is known of it.
    void start(double speed_m_s);
    /// As what drove another fluid of the same scene until now. Null: nobody has watched, and it may have been as fast as anything.
    void take_over(const Driven* from, double time_s);
    /// After dt_s in which the bodies got to these states; `time_s`: when that began.
    void go_on(const std::vector<BodyState>& bodies, double time_s, double dt_s);

    /// kNoLimit where it is not known. Vorticity confinement pushes no fluid that is much faster: it would feed an eddy for ever.
    double lately_m_s() const;
    /// What goes through a gap of less than a quarter of a cell, relative to its sides: the gap closes or opens faster than any
    /// cell can tell, and continuity would have the fluid a thousand times as fast as the body. With what gravity adds in a step,
    /// which the pressure takes off again. No limit where the scene has a force of its own.
    double through_gaps_m_s(double dt_s) const;
    /// A jet or an inflow has just begun or ended, or all but: the last pressure says little about this one.
    bool is_sudden() const { return is_sudden_; }

  private:
    /// Where a wall's velocity is looked at: each face, as the shaders see it, so that no inlet is missed. A formula takes a
    /// third of a microsecond; only walls that vary in space and in time are asked at each face in each step.
    struct Face {
        const WallSetup* wall;
        glm::dvec3 x_m;
    };

    /// What jets and walls make the fluid do in a step: jets as they are when it begins, walls as they are when it ends.
    /// Returns the largest change since the last look [m/s].
    double look_at_inflow(double begins_s, double ends_s);

    const FluidSetup* setup_;
    bool unknown_;
    std::vector<Face> faces_;  ///< of walls that vary in time
    double steady_m_s_ = 0.0;  ///< the fastest of those that do not
    double known_lately_m_s_ = 0.0, known_ever_m_s_ = 0.0;
    std::vector<glm::dvec3>
        inflow_m_s_;  ///< of each source, then of each of faces_; empty: not looked at yet
    bool is_sudden_ = false;
};

}  // namespace eddy::gles
