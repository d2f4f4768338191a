#pragma once
#include "gles/fluid/diagnosis.h"
#include "gles/fluid/fluid.h"
#include "gles/fluid/health.h"
#include "gles/fluid/results.h"
#include "gles/fluid/scalar.h"

namespace eddy::gles {

/// A flow given by a formula, which smoke and heat follow: no pressure, no projection, no force. It takes no
/// notice of the tank's walls; what it brings in from outside is clear and at the reference temperature.
class ImposedFluid final : public Fluid {
  public:
    ImposedFluid(Gpu& gpu, FluidSetup setup);

    long steps() const override { return step_; }
    const Field<Cells>* smoke() const override { return smoke_ ? &smoke_->field() : nullptr; }
    const Field<Cells>* temperature() const override {
        return temperature_ ? &temperature_->field() : nullptr;
    }
    /// What the formula says at the end of the last step.
    std::vector<glm::vec3> velocity() const override;
    /// There is none: throws std::logic_error, as does set_velocity().
    std::vector<float> pressure() const override;
    void set_velocity(const std::vector<glm::vec3>& u) override;

  private:
    void move_on(double dt_s, const std::vector<BodyState>& bodies, bool diagnose) override;
    std::optional<StepResult> take_result(bool wait) override { return results_.take(wait); }
    void start_over() override;
    FluidState state() const override;
    void resume(const FluidState& from) override;
    Field<Faces> flow_at(double time_s) const;
    void diagnose();

    Gpu& gpu_;
    long step_ = 0;
    double time_s_ = 0.0;
    Walls walls_;
    mutable Pass flow_;  ///< drawn by velocity() as well
    Field<Faces> u_;     ///< in the middle of the step [m/s]; drawn once if the flow is steady
    std::optional<Scalar> smoke_, temperature_;
    std::optional<Pass> divergence_;
    std::optional<Resample> resample_;  ///< to take over from another
    HealthCheck health_;                ///< of what the flow carries
    Diagnosis diagnosis_;
    Results results_;
};

}  // namespace eddy::gles
