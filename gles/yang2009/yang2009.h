#pragma once
#include <optional>

#include "gles/fluid/fluid.h"
#include "gles/fluid/health.h"
#include "gles/fluid/resample.h"
#include "gles/fluid/results.h"
#include "gles/fluid/transport.h"
#include "gles/reduce.h"
#include "gles/yang2009/force.h"
#include "gles/yang2009/jacobi.h"
#include "gles/yang2009/viscosity.h"

namespace eddy::gles {

/// The yardstick: the pipeline of Yang, Lu, Safonova & Kuchenbecker 2009, "GPU Methods for Real-Time Haptic
/// Interaction with 3D Fluids", over the solver it follows, Crane, Llamas & Tariq 2007 (GPU Gems 3, ch. 30).
/// Collocated grid: velocity and pressure at cell centres; obstacles are whole cells; semi-Lagrangian
/// whatever setup.solver.advection says. A viscous fluid sticks to obstacles and to walls that have
/// friction; nothing flows through any wall.
///
/// Two properties of the method, kept as they are: the wide divergence and the compact Laplacian do not
/// match, so that divergence remains after the projection however many sweeps; and of an obstacle's sudden
/// change of velocity half the flux is seen in that step and the other half in the next, since a face takes
/// the mean of its two cells.
class Yang2009Fluid final : public Fluid {
  public:
    Yang2009Fluid(Gpu& gpu, FluidSetup setup);

    long steps() const override { return step_; }
    const Field<Cells>* smoke() const override { return smoke_ ? &*smoke_ : nullptr; }
    /// At cell centres: (nx)(ny)(nz) entries; in obstacle cells the obstacle's velocity.
    std::vector<glm::vec3> velocity() const override;
    /// In obstacle cells: without meaning.
    std::vector<float> pressure() const override;
    void set_velocity(const std::vector<glm::vec3>& u) override;

  private:
    void move_on(double dt_s, const std::vector<BodyState>& bodies, bool diagnose) override;
    std::optional<StepResult> take_result(bool wait) override { return results_.take(wait); }
    void start_over() override;
    FluidState state() const override;
    void resume(const FluidState& from) override;
    /// Projects u_ as it is, with the bodies where they are: no time passes, and nobody feels anything.
    void free_of_divergence();
    const Voxels* voxels() const { return voxels_ ? &*voxels_ : nullptr; }
    std::vector<Input> with_obstacles(std::vector<Input> inputs) const;
    Field<Cells> advect_velocity();
    Field<Cells> drive_sources(Field<Cells> u);
    Field<Cells> advect_smoke();
    Field<Cells> divergence(const Field<Cells>& u);
    Field<Cells> subtract_gradient(const Field<Cells>& u);
    void diagnose(const Field<Cells>& before);

    // --- state, and who writes it                                             unit       cells
    Gpu& gpu_;
    Field<Cells> u_;                     // velocity, subtract_gradient          m/s       (nx, ny, nz)
    Field<Cells> phi_;                   // dt p / (rho h), Jacobi               m/s       (nx, ny, nz)
    std::optional<Field<Cells>> smoke_;  // density, advect_smoke                1         (nx, ny, nz)
    long step_ = 0;
    double time_s_ = 0.0;
    double dt_s_ = 0.0;

    // --- passes the scene called for
    std::optional<Voxels> voxels_;
    BodyUniforms body_uniforms_;
    Pass advect_velocity_;
    std::optional<Viscosity> viscosity_;
    std::optional<Pass> drive_;
    std::optional<Pass> advect_smoke_, smoke_sources_;
    std::vector<glm::vec4> smoke_balls_;  ///< sources of smoke: centre, radius [cells]
    std::vector<Box> smoke_boxes_;
    Pass divergence_;
    Jacobi pressure_;
    Pass project_;
    std::optional<VoxelForce> force_;
    std::optional<Resample> resample_;  ///< to take over from another
    std::optional<Pass> diagnose_;
    std::optional<Reduce> reduce_diagnosis_;
    HealthCheck health_;
    Results results_;  // loads, diagnosis and health
};

}  // namespace eddy::gles
