#pragma once
#include <vector>

#include "firmware/stability/fields.h"

namespace eddy::stability {

/// What came of a trial, step by step, for the criteria of single cases.
struct History {
    struct Step {
        double time_s = 0.0;  ///< at its end
        double dt_s = 0.0;    ///< that the fluid took
        bool disturbed = true;
        long resets = 0;                     ///< so far
        std::vector<gles::Load> loads = {};  ///< without what bodies feel at rest
        std::vector<gles::BodyState> bodies = {};
        std::vector<gles::ForceMethods> methods = {};  ///< where the scene asks for them
        double wall_s = 0.0;                           ///< it took
    };
    /// What was found in the fields after a step.
    struct Look {
        long step = 0;  ///< from 0
        double speed_m_s = 0.0;
        double energy_j = 0.0;
        FieldRange pressure_pa = {};
        FieldRange smoke = {}, temperature_k = {};
        double in_m3_s = 0.0, net_m3_s = 0.0;  ///< through the walls: what comes in; that less what goes out
        long non_finite = 0;
        double measured = 0.0;  ///< what the case itself measures (Case::measure)
    };
    /// What the hand got at a tick.
    struct Tick {
        double time_s = 0.0;
        double force_n = 0.0;
        bool answered = true;  ///< steps since reached the hand
    };
    Tank tank;
    double gravity_m_s2 = 0.0;
    double start_energy_j = 0.0, start_speed_m_s = 0.0;
    long planned_steps = 0;  ///< it may have been cut short
    std::vector<Step> steps = {};
    std::vector<Look> looks = {};
    std::vector<Tick> ticks = {};
    /// Forces on body 0 of the common scene, step by step, if the case compares itself with it (Case::compares).
    std::vector<glm::dvec3> common_n = {};
};

History::Look look_at(const Tank& tank, const Fields& fields, long step);

}  // namespace eddy::stability
