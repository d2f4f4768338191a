#pragma once
#include <optional>
#include <vector>

#include "gles/body/rigid_body.h"
#include "gles/fluid/contacts.h"
#include "gles/fluid/pressure.h"
#include "gles/fluid/resample.h"
#include "gles/fluid/traction.h"
#include "gles/linear_system.h"
#include "gles/readback.h"

namespace eddy::gles {

/// Bodies that the fluid moves: free ones, and held ones that turn in the hand.
///
/// The pressure is linear in their velocities, so fluid and bodies are solved for together and light bodies are as
/// stable as heavy ones. phi_g is the pressure for a guess V_g of the velocities, phi_k what it gains when velocity k grows
/// by 1 (the potential of Kirchhoff; kept from step to step, moved along, and improved by a V-cycle). With the forces
/// J phi of a pressure, Newton's law for the velocities V at the end of the step is a small system of equations:
///
///   (M + M_a + dt D) (V - V_g) = M V_before - M V_g + rho h^3 (J phi_g + friction) + dt weight,
///   M_a = -rho h^3 J phi_k    the added mass
///
/// and the pressure of the step is phi_g + sum (V - V_g) phi_k. Friction is what V_g causes; D, an estimate of its
/// resistance to more (resistance.h), keeps light bodies stable in thick fluids and is multiplied by 0 when the motion is
/// steady. The guess goes on with the last step's acceleration, by the share (M + M_a) / (M + M_a + dt D) of it: where friction
/// rules, a velocity ends at once what it was heading for.
///
/// The sums J phi must be known before the step can end: a scene with such a body waits for the GPU once a step.
///
/// Walls and other bodies stop a body before it touches them (contacts.h).
class Coupling {
  public:
    /// `pressure` and `uniforms` must outlive this.
    Coupling(Gpu& gpu, const FluidSetup& setup, Pressure& pressure, BodyUniforms& uniforms);
    /// Whether any body is moved by the fluid.
    static bool needed(const FluidSetup& setup);

    /// The bodies where they are at the end of the step, with a guess of their velocities there. Of coupled ones, `given`
    /// is where they start; `before` are all bodies after the last step, empty before the first.
    std::vector<BodyState> predict(const std::vector<BodyState>& given, const std::vector<BodyState>& before,
                                   double dt_s);

    struct Step {
        const Field<Cells4>& phi;  ///< for the guess
        const FaceFractions& a;
        const std::vector<Box>& boxes;
        std::vector<Displacement> since;             ///< the last step; empty in the first
        std::optional<Traction::Friction> friction;  ///< if the fluid is viscous
        double dt_s;
    };
    /// Solves for the velocities at the end of the step, puts them into `states`, and leaves the uniforms with them.
    void solve(std::vector<BodyState>& states, const Step& step);
    /// phi for those velocities from one for the guess.
    Field<Cells4> add_to(Field<Cells4> phi);
    /// Goes on from another's of the same grid, bit for bit. Whether it could: whether both solve for the same velocities.
    bool copy(const Coupling& from, Resample& resample);
    /// Goes on from another grid's, or none (null), with the bodies at these states.
    void start(const Coupling* from, const std::vector<BodyState>& states, const FaceFractions& a,
               const std::vector<Box>& boxes);
    /// Forgets everything about the last step.
    void reset();

  private:
    struct Body {
        std::size_t index;
        RigidBody solid;
        double density_ratio;  ///< to the fluid's
    };
    /// Three velocities that the fluid decides: of a body's centre, in m/s, or of its turning, in m/s per cell.
    struct Triple {
        std::size_t body = 0;  ///< in bodies_
        bool turns = false;
        std::vector<Field<Cells4>> potentials{};  ///< phi_k; none if pressure cannot turn it
        glm::dvec3 acceleration{0.0};             ///< in the last step
        glm::dvec3 trust{1.0};                    ///< share of it that the next guess goes on with
        glm::dvec3 change{0.0};                   ///< V - V_g, as the body has it
    };
    /// Velocity number k = 3 (triple) + axis: which body (in bodies_, in the scene), which of its six velocities, and what
    /// makes SI of it.
    struct Unknown {
        std::size_t body, index, component;
        double scale;
    };
    struct Sums;

    Unknown unknown(std::size_t k) const;
    /// phi_k, where the bodies are now; `since`: see Step.
    void draw_potentials(const std::vector<BodyState>& states, const FaceFractions& a,
                         const std::vector<Box>& boxes, const std::vector<Displacement>& since);
    bool solves_for_the_same_as(const Coupling& other) const;
    /// J phi of all pressures.
    Sums add_up(const std::vector<BodyState>& states, const Step& step);
    LinearSystem newton(const std::vector<BodyState>& states, const Step& step, const Sums& sums);

    Gpu& gpu_;
    const FluidSetup& setup_;
    Pressure& pressure_;
    BodyUniforms& uniforms_;
    std::vector<Body> bodies_;
    std::vector<Triple> triples_;
    std::vector<BodyState> before_;  // all bodies, at the end of the last step
    std::vector<Box> boxes_before_;
    bool cold_ = true;  // potentials start from 0
    Contacts contacts_;
    std::vector<Contacts::Unknowns> unknowns_;  // of each body of the scene
    Pass flux_, add_;
    Field<Cells4> b_;                           // of a unit velocity; 0 away from the bodies
    std::optional<Field<Cells4>> hydrostatic_;  // g . x [m/s^2 cells]
    Traction pressing_;                         // sums up a pressure alone,
    std::optional<Traction> rubbing_;           // and with it the friction of a viscous fluid
    TexturePool::Lease row_;
    Readback readback_;
};

}  // namespace eddy::gles
