#pragma once
#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace eddy::gles {

// What a fluid is made of and what moves in it, in SI units and the Tank frame (hal/frames.h). Fixed while it
// runs.

// Shapes, centred on the body's centre; where there is an axis, it is y of the body.
struct Sphere {
    double radius_m = 0.01;
};
struct Cuboid {
    glm::dvec3 size_m{0.02};  ///< full edges
};
struct Capsule {
    double radius_m = 0.005, length_m = 0.02;  ///< between the centres of its caps
};
struct Cylinder {
    double radius_m = 0.01, length_m = 0.02;  ///< a disk is a short one
};
struct Torus {
    double radius_m = 0.01, tube_radius_m = 0.003;  ///< of the ring's middle line, and of the tube
};
struct Ellipsoid {
    glm::dvec3 radii_m{0.01};
};
/// A flat blade under a round handle, both along y; the centre is the blade's. The handle starts there; its
/// length is what shows above the blade.
struct Paddle {
    glm::dvec3 blade_m{0.02, 0.03, 0.003};  ///< full edges
    double handle_radius_m = 0.002, handle_length_m = 0.03;
};
/// Regular: a corner on +y, and one of the lower three at x = 0, z > 0.
struct Tetrahedron {
    double edge_m = 0.02;
};
class DistanceGrid;
/// A closed surface of triangles, as signed distances on a grid (gles/body/distance_grid.h).
struct Mesh {
    std::shared_ptr<const DistanceGrid> distance;
};
using Shape = std::variant<Sphere, Cuboid, Capsule, Cylinder, Torus, Ellipsoid, Paddle, Tetrahedron, Mesh>;

/// A body that the fluid moves.
struct Coupled {
    double density_kg_m3 = 1000.0;  ///< the same all through it
    bool moves = true;              ///< the fluid decides the velocity of its centre; else its states say it
    bool turns = true;              ///< and its spin
};

struct BodySetup {
    Shape shape;
    bool inside_out = false;           ///< solid outside the shape: a container
    bool force = true;                 ///< measure the force of the fluid on it
    bool torque = true;                ///< and the torque about its centre
    std::optional<Coupled> coupled{};  ///< not in Yang2009
};

/// A vector field as GLSL: one expression for each component, of the floats x, y, z [m] and t [s].
struct VectorFormula {
    std::array<std::string, 3> glsl{"0.0", "0.0", "0.0"};
};

enum class WallKind {
    Slip,    ///< no flow through, no friction along
    NoSlip,  ///< no flow through; the fluid at the wall moves with it
    Inflow,  ///< the fluid comes in, or is drawn off, with the wall's velocity
    Open     ///< the fluid comes and goes; pressure 0 outside
};
struct WallSetup {
    WallKind kind = WallKind::Slip;
    VectorFormula velocity_m_s{};  ///< of NoSlip, along it, and of Inflow
    /// The same at a place [m] and time [s], for what no shader computes (force_methods, Driven); empty: not known.
    std::function<glm::dvec3(const glm::dvec3&, double)> velocity_at{};
    bool varies_in_space = true, varies_in_time = true;  ///< velocity_at; what does not needs fewer looks
};

/// A ball of fluid that is driven, or from which smoke comes, or both.
struct SourceSetup {
    glm::dvec3 centre_m{0.0};
    double radius_m = 0.01;
    std::optional<glm::dvec3>
        velocity_m_s{};                ///< the fluid inside is given this velocity before each projection
    double smoke_per_s = 0.0;          ///< smoke density added per second
    double temperature_k_per_s = 0.0;  ///< how fast it heats up
    double start_s = 0.0;
    double stop_s = std::numeric_limits<double>::infinity();
};

struct SmokeSetup {
    double dissipation_1_s = 0.0;  ///< exponential decay rate of the density
    double weight = 0.0;           ///< relative density excess of fluid with smoke of density 1 (Boussinesq)
    /// Density at the start at a place of the tank [m]; empty: none.
    std::function<double(const glm::dvec3&)> at_start{};
};

/// Heat, as the excess of the temperature over a reference at which the fluid has its density.
struct TemperatureSetup {
    double expansion_1_k = 0.0;  ///< relative density deficit of fluid that is a kelvin warmer (Boussinesq)
    double diffusivity_m2_s = 0.0;  ///< kappa
    /// At the start at a place of the tank [m]; empty: 0.
    std::function<double(const glm::dvec3&)> at_start_k{};
};

/// The flow, where it is not solved for.
struct ImposedSetup {
    VectorFormula velocity_m_s{};
    bool steady = false;  ///< the formula has no t in it
};

enum class Method {
    CutCell,  ///< staggered grid, volume fractions of the body, multigrid
    Yang2009  ///< the paper: collocated grid, four cell types, Jacobi
};
enum class Advection {
    SemiLagrangian,  ///< first order; one displacement per cell moves the three faces and is therefore not
                     ///< quite mirror-symmetric; the cheapest
    MacCormack       ///< second order with limiter, each face traced from its own centre
};

/// How Yang2009 adds up the force of each cell.
enum class ForceSum {
    Gpu,  ///< by parallel reduction, and one small read-back
    Cpu   ///< reads the whole force texture back and adds it up there: what the paper compares with
};

struct SolverSetup {
    Method method = Method::CutCell;
    Advection advection = Advection::SemiLagrangian;
    int cycles = 2;      ///< multigrid V-cycles a step (CutCell)
    int time_order = 1;  ///< 2: advection-reflection (CutCell, inviscid, no coupled bodies, no force_methods)
    int viscous_cycles = 2;  ///< the same for the viscous term, where there is one
    int jacobi_sweeps = 40;  ///< (Yang2009)
    ForceSum force_sum = ForceSum::Gpu;
};

struct FluidSetup {
    glm::ivec3 cells{32};
    double cell_m = 0.005;  ///< h, edge of the cubic cell
    double density_kg_m3 = 1.2;
    double viscosity_pa_s = 0.0;  ///< mu, dynamic; 0: no viscous term anywhere
    glm::dvec3 gravity_m_s2{0.0};
    double shortest_step_s = 0.0;  ///< a shorter step is none (step_guard.h)
    double longest_step_s = std::numeric_limits<double>::infinity();  ///< and none is longer
    std::array<WallSetup, 6> walls{};                  ///< x low, x high, y low, y high, z low, z high
    std::optional<VectorFormula> acceleration_m_s2{};  ///< a force on all of the fluid, per mass
    double confinement_1_s = 0.0;           ///< eps of vorticity confinement, f = eps h (N x w); 0: none
    std::optional<ImposedSetup> imposed{};  ///< walls, bodies and forces do nothing then
    std::string formula_helpers{};          ///< GLSL functions that the formulas call
    /// Velocity at the start at a place of the tank [m]; empty: at rest.
    std::function<glm::dvec3(const glm::dvec3&)> velocity_at_start{};
    /// In place of that: what Fluid::velocity() gives. Empty: none.
    std::vector<glm::vec3> velocities_at_start{};
    std::optional<SmokeSetup> smoke{};
    std::optional<TemperatureSetup> temperature{};
    std::vector<SourceSetup> sources{};
    std::vector<BodySetup> bodies{};
    bool force_methods =
        false;  ///< measure forces in two more ways (gles/fluid/force_methods.h); CutCell only
    SolverSetup solver;
};

/// nu dt / h^2: how many cells far, squared, momentum diffuses in a step.
inline float diffusion_number(const FluidSetup& setup, double dt_s) {
    return static_cast<float>(setup.viscosity_pa_s / setup.density_kg_m3 * dt_s /
                              (setup.cell_m * setup.cell_m));
}

/// Where a body is and how it moves at the end of a step.
struct BodyState {
    glm::dvec3 centre_m{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 velocity_m_s{0.0};
    glm::dvec3 spin_rad_s{0.0};
};

/// Force on a body by other ways than the sum of the stress over its surface (gles/fluid/force_methods.h), and the force that
/// transport made or lost around it, for it does not conserve momentum.
struct ForceMethods {
    glm::dvec3 box_n{0.0};
    glm::dvec3 impulse_n{0.0};
    glm::dvec3 transport_n{0.0};
};

/// Force and torque (about the body's centre) ON the body BY the fluid, Tank frame.
struct Load {
    glm::dvec3 force_n{0.0};
    glm::dvec3 torque_nm{0.0};
};

}  // namespace eddy::gles
