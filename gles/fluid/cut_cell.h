#pragma once
#include <optional>

#include "gles/body/fractions.h"
#include "gles/body/traction.h"
#include "gles/fluid/fluid.h"
#include "gles/fluid/pressure.h"
#include "gles/fluid/transport.h"
#include "gles/fluid/results.h"

namespace eddy::gles {

/// Incompressible flow on a staggered grid with cut cells: what the exhibit runs. Which passes and textures
/// exist is decided here, once, by the scene: no body, no fractions; no smoke, no smoke texture.
class CutCellFluid final : public Fluid {
  public:
    CutCellFluid(Gpu& gpu, FluidSetup setup);

    void step(double dt_s, const std::vector<BodyState>& bodies, bool diagnose) override;
    std::optional<StepResult> result(bool wait) override { return results_.take(wait); }
    long steps() const override { return step_; }
    void reset() override;
    const Field<Cells>* smoke() const override { return smoke_ ? &*smoke_ : nullptr; }
    std::vector<glm::vec3> velocity() const override;
    std::vector<float> pressure() const override;
    void set_velocity(const std::vector<glm::vec3>& u) override;

  private:
    std::vector<BodyMotion> motions(const std::vector<BodyState>& bodies) const;
    Field<Faces> drive_sources(Field<Faces> u);
    Field<Cells4> divergence(const Field<Faces>& u);
    Field<Faces> subtract_gradient(const Field<Faces>& u);
    void diagnose(const Field<Cells4>& before);

    // --- state, and who writes it                                             unit       cells
    Gpu& gpu_;
    Field<Faces> u_;                     // velocity, subtract_gradient          m/s       (nx+1, ny+1, nz+1)
    Field<Cells4> phi_;                  // dt p / (rho h), Pressure             m/s       (nx, ny, nz)
    std::optional<Field<Cells>> smoke_;  // density, SmokeTransport              1         (nx, ny, nz)
    std::vector<BodyState> before_;      // bodies at the end of the last step
    std::vector<Box> boxes_;             // cells near each body, this step
    long step_ = 0;
    double time_s_ = 0.0;
    double dt_s_ = 0.0;

    // --- passes the scene called for
    VelocityTransport advect_;
    std::optional<SmokeTransport> advect_smoke_;
    std::optional<Pass> drive_;
    std::optional<Fractions> fractions_;
    BodyUniforms body_uniforms_;
    Pass divergence_;
    std::optional<Pass> divergence_cut_;
    Pressure pressure_;
    Pass project_, project_walls_;
    std::optional<Pass> project_cut_;
    std::optional<Traction> traction_;
    std::optional<Pass> diagnose_;
    std::optional<Reduce> reduce_diagnosis_;
    Results results_;  // loads and diagnosis
};

}  // namespace eddy::gles
