#pragma once
#include <optional>

#include "gles/body/displacement.h"
#include "gles/body/fractions.h"
#include "gles/fluid/body_forces.h"
#include "gles/fluid/confinement.h"
#include "gles/fluid/coupling.h"
#include "gles/fluid/diagnosis.h"
#include "gles/fluid/driven.h"
#include "gles/fluid/fluid.h"
#include "gles/fluid/force_methods.h"
#include "gles/fluid/health.h"
#include "gles/fluid/jets.h"
#include "gles/fluid/pressure.h"
#include "gles/fluid/pressure_level.h"
#include "gles/fluid/projection.h"
#include "gles/fluid/reflection.h"
#include "gles/fluid/resample.h"
#include "gles/fluid/results.h"
#include "gles/fluid/scalar.h"
#include "gles/fluid/traction.h"
#include "gles/fluid/transport_energy.h"
#include "gles/fluid/viscous_term.h"
#include "gles/fluid/walls.h"

namespace eddy::gles {

/// Incompressible flow on a staggered grid with cut cells: what the exhibit runs. Which passes and textures
/// exist is decided here, once, by the scene: no body, no fractions; no smoke, no smoke texture.
class CutCellFluid final : public Fluid {
  public:
    /// Throws std::logic_error where the setup asks for what SolverSetup rules out.
    CutCellFluid(Gpu& gpu, FluidSetup setup);

    long steps() const override { return step_; }
    const Field<Cells>* smoke() const override { return smoke_ ? &smoke_->field() : nullptr; }
    const Field<Cells>* temperature() const override {
        return temperature_ ? &temperature_->field() : nullptr;
    }
    std::vector<glm::vec3> velocity() const override;
    std::vector<float> pressure() const override;
    std::vector<ForceMethods> force_methods() const override {
        return force_methods_ ? force_methods_->forces() : std::vector<ForceMethods>();
    }
    void set_velocity(const std::vector<glm::vec3>& u) override;

  private:
    void move_on(double dt_s, const std::vector<BodyState>& bodies, bool diagnose) override;
    std::optional<StepResult> take_result(bool wait) override { return results_.take(wait); }
    void start_over() override;
    FluidState state() const override;
    void resume(const FluidState& from) override;
    /// Projects u_ as it is, with the bodies where they are: no time passes, and nobody feels anything.
    void free_of_divergence();
    /// Friction and pressure of a step at the same time and place. A coarser grid does not know how steeply the flow falls off
    /// beside a body: friction in the first step would be 6 to 10 % high (glycerine, ball of 4 and 2 cells).
    void settle();
    /// All of a step, which began at start_s, or one of its halves: leaves u_, phi_ and time_s_ at its end. Returns the
    /// divergence before its projection.
    Field<Cells4> advance(Part part, double start_s, std::vector<BodyState>& bodies);
    /// Puts the bodies where they are; returns what the pressure has to do around them and the jets.
    Pressure::Work place(const std::vector<BodyState>& bodies, float guess_scale);
    /// How far the bodies came since they were where phi_ belongs.
    std::vector<Displacement> since_last_pressure(Part part, const std::vector<BodyState>& bodies) const;
    /// The viscous step, with the last step's pressure in it.
    Field<Faces> diffuse(const Field<Faces>& u, Pressure::Work& work);
    Field<Cells4> divergence(const Field<Faces>& u);
    Field<Cells4> solve_pressure(Part part, const Field<Cells4>& b, const Pressure::Work& work);
    Field<Faces> project(const Field<Faces>& u, const Field<Cells4>& phi, float scale);
    /// Gives the coupled bodies their velocities, and phi what those change in it.
    void couple(std::vector<BodyState>& bodies);
    /// A velocity on its way through the step, for whoever adds up forces from it.
    void keep(ForceMethodsPass::Which which, const Field<Faces>& u);
    /// What friction is computed from, in a viscous fluid.
    std::optional<Traction::Friction> friction() const;
    bool is_viscous() const { return setup_.viscosity_pa_s > 0.0; }

    // --- state, and who writes it                                             unit       cells
    Gpu& gpu_;
    Field<Faces> u_;           // velocity, project                    m/s       (nx+1, ny+1, nz+1)
    Field<Cells4> phi_;        // dt p / (rho h), Pressure             m/s       (nx, ny, nz)
    Field<Cells4> increment_;  // of phi, viscous step or second half  m/s       (nx, ny, nz)
    Field<Faces> diffused_;    // u**, diffuse: what friction comes from m/s     (nx+1, ny+1, nz+1)
    Field<Faces> mirrored_;    // 2 u - u*, between the halves         m/s       (nx+1, ny+1, nz+1)
    std::vector<Box> boxes_;   // cells near each body, this step
    long step_ = 0;
    double time_s_ = 0.0;
    double dt_s_ = 0.0;
    float guess_scale_ = 1.0f;           // dt over the last one
    Sound sound_ = sound(setup_, 1e-3);  // in this step
    Driven driven_{setup_};

    // --- passes the scene called for
    Walls walls_;
    VelocityTransport advect_;
    Jets jets_;
    std::optional<Confinement> confinement_;
    std::optional<TransportEnergy> transport_energy_;
    std::optional<BodyForces> body_forces_;
    std::optional<Fractions> fractions_;
    std::optional<Scalar> smoke_, temperature_;  // with their fields: density [1], excess [K]
    BodyUniforms body_uniforms_;
    Pressure pressure_;
    std::optional<PressureLevel> pressure_level_;
    Projection projection_;
    std::optional<ViscousTerm> viscosity_;
    std::optional<Pass> add_pressure_;
    std::optional<Reflection> reflection_;
    std::optional<Coupling> coupling_;
    std::optional<Traction> traction_;
    std::optional<ForceMethodsPass> force_methods_;
    std::optional<Resample> resample_;  // to take over from another
    HealthCheck health_;
    Diagnosis diagnosis_;
    Results results_;  // loads, diagnosis and health
};

}  // namespace eddy::gles
