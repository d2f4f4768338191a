#pragma once
#include "config/scene.h"
#include "firmware/stability/rule.h"

namespace eddy::stability {

/// The books of what acts on the fluid of a scene, from what the scene says and where its bodies went: what speed, work, smoke
/// and heat that justifies. Where work cannot be known exactly it is counted high, as each line of ledger.cpp says.
class Ledger {
  public:
    /// What the books know of the work at walls that fluid comes in through.
    enum class Inflow {
        Estimated,  ///< from the scene
        Seen        ///< from the fields, which are shown after each step (add_fields)
    };
    /// `narrowing`: see Justified.
    Ledger(const Scene& scene, const gles::FluidSetup& setup, double narrowing = 1.0,
           Inflow inflow = Inflow::Estimated);

    /// A step of dt_s that ended at time_s, with the bodies as the fluid has taken them and the loads on them, less at_rest();
    /// `loads` may be empty if none were measured: then bodies justify the energy of a tank that moves as fast as they do.
    void add(double time_s, double dt_s, const std::vector<gles::BodyState>& bodies,
             const std::vector<gles::Load>& loads);
    /// The fields as the last dt_s left them. What they tell of work is added up (field_work.h).
    void add_fields(double dt_s, const Fields& fields);
    Justified justified() const;
    /// What bodies feel in fluid at rest: their lift.
    std::vector<gles::Load> at_rest() const;

  private:
    void add_bodies(double dt_s, const std::vector<gles::BodyState>& bodies,
                    const std::vector<gles::Load>& loads);
    void add_sources(double time_s, double dt_s);
    void add_walls(double time_s, double dt_s);
    void add_weight();
    void faster(double speed_m_s) { justified_.speed_m_s = std::max(justified_.speed_m_s, speed_m_s); }
    /// Kinetic energy that the rule finds in and on a body, whatever the fluid does.
    double around_j(std::size_t body, double speed_m_s) const;
    void give(double work_j);
    /// It may be done now or later.
    void give_ahead(double work_j);
    /// Of the whole tank at this speed: given once, for the fastest so far.
    void whole_tank(double& fastest_m_s, double speed_m_s);

    const Scene scene_;
    const gles::FluidSetup setup_;
    const Tank tank_;
    std::vector<double> volume_m3_, radius_m_;  ///< of bodies
    std::vector<bool> running_;                 ///< sources, in the last step
    const bool inflow_seen_;
    Justified justified_;
    double bodies_m_s_ = 0.0, walls_m_s_ = 0.0, weight_m_s_ = 0.0, forcing_m_s_ = 0.0, swirl_m_s_ = 0.0;
    bool others_drive_;     ///< something else than bodies puts energy into the fluid
    double solid_j_ = 0.0;  ///< kinetic energy of what bodies displace, as they move now
    double smoke_start_ = 0.0, heat_start_k_ = 0.0;
};

}  // namespace eddy::stability
