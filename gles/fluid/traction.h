#pragma once
#include <optional>
#include <vector>

#include "gles/body/fractions.h"
#include "gles/body/grip.h"
#include "gles/reduce.h"

namespace eddy::gles {

/// What of a body's load is asked for: 0 the force, 1 the torque; and the switches FORCE, TORQUE of a shader that writes
/// just these, as its first output, its second.
std::vector<int> parts_asked_for(const BodySetup& body, Variant& variant);

/// Force and torque of the pressure, and of friction if the fluid is viscous, on each body, summed on the GPU over
/// the body's box only.
class Traction {
  public:
    /// `target_width`: width in texels of the row that takes the results.
    Traction(Gpu& gpu, const FluidSetup& setup, int target_width);

    /// What friction is computed from: the velocity that the viscous step left, where the bodies hold it, and
    /// nu dt / h^2.
    struct Friction {
        const Field<Faces>& velocity;
        const Grip& grip;
        float lambda;
    };

    /// Writes, for body i, sum(phi grad(1-a)), friction added, to texel `first` + 2i of `target` and its moment to the one
    /// beside it, as far as they are asked for: in m/s cells^2 and m/s cells^3. Times rho h^3/dt and rho h^4/dt they are newtons and newton metres.
    void draw(const Field<Cells4>& phi, const FaceFractions& a, const BodyUniforms& uniforms,
              const std::vector<BodyState>& states, const std::vector<Box>& boxes, const Texture& target,
              const std::optional<Friction>& friction, int first = 0);

  private:
    struct Body {
        int index;
        std::vector<int> parts;  ///< asked for
        glm::ivec2 columns;
        Pass sum_columns;
        Reduce reduce;
    };
    Gpu* gpu_;
    double cell_m_;
    std::vector<Body> bodies_;
};

}  // namespace eddy::gles
