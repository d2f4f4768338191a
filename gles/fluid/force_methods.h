#pragma once
#include <vector>

#include "gles/body/fractions.h"
#include "gles/fluid/fluid.h"

namespace eddy::gles {

/// Velocities of one step as they come about, on the CPU and in the order of Fluid::velocity(). Those of a step without
/// friction have no `predicted` and no `diffused`.
struct StepVelocities {
    std::vector<glm::vec3> before;     ///< at the start of the step
    std::vector<glm::vec3> carried;    ///< after the transport
    std::vector<glm::vec3> forced;     ///< after jets and body forces: u*
    std::vector<glm::vec3> predicted;  ///< and the last step's pressure
    std::vector<glm::vec3> diffused;   ///< and friction: u**
    std::vector<glm::vec3> after;      ///< at the end
};

/// The force on each body in two more ways than Traction's, from whole fields added up in double precision on the CPU.
/// For the laboratory: each step waits for the GPU.
///
/// Box. Cells around the body, each nearer to it than to any other. What pressure and friction took from the momentum of the
/// fluid in them, and what pressure and friction on their outer faces brought in, is the force. Momentum is counted from where
/// transport, jets and body forces left it: transport that does not conserve it changes no force; what it makes or loses
/// is told apart (ForceMethods::transport_n).
///
/// Impulse. At each face next to the body: its solid share (1 - a) of the velocity change that the projection made there
/// (inside, where no fluid tells, of the pressure difference), which is Gauss' theorem for the pressure on the
/// surface; and of the change that the viscous step made, what its neighbours in the fluid do not explain.
class ForceMethodsPass {
  public:
    ForceMethodsPass(Gpu& gpu, const FluidSetup& setup);

    /// One of StepVelocities.
    using Which = std::vector<glm::vec3> StepVelocities::*;
    /// Keeps one of this step.
    void keep(Which which, const Field<Faces>& u);
    /// When all of them are kept: the forces. `time_s`: at the end of the step.
    void add_up(const Field<Cells4>& phi, const FaceFractions& a, const BodyUniforms& uniforms,
                const std::vector<Box>& boxes, double time_s, double dt_s);
    /// Of the last step, one for each body.
    const std::vector<ForceMethods>& forces() const { return forces_; }
    /// Goes on from the same grid's.
    void take_over(const ForceMethodsPass& from) {
        shares_before_ = from.shares_before_;
        forces_ = from.forces_;
    }
    /// Forgets the shares of the last step.
    void reset() {
        shares_before_.clear();
        forces_.clear();
    }

  private:
    const FluidSetup& setup_;
    Pass owners_;
    Field<Faces> owner_field_;
    StepVelocities u_;
    std::vector<glm::vec3> shares_before_;
    std::vector<ForceMethods> forces_;
};

}  // namespace eddy::gles
