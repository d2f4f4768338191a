#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace eddy::gles {

// What a fluid is made of and what moves in it, in SI units and the Tank frame (hal/frames.h). Fixed while it
// runs.

struct Sphere {
    double radius_m = 0.01;
};
using Shape = std::variant<Sphere>;

struct BodySetup {
    Shape shape;
    bool force = true;   ///< measure the force of the fluid on it
    bool torque = true;  ///< and the torque about its centre
};

/// A ball of fluid that is driven, or from which smoke comes, or both.
struct SourceSetup {
    glm::dvec3 centre_m{0.0};
    double radius_m = 0.01;
    std::optional<glm::dvec3>
        velocity_m_s{};        ///< the fluid inside is given this velocity before each projection
    double smoke_per_s = 0.0;  ///< smoke density added per second
    double start_s = 0.0;
    double stop_s = std::numeric_limits<double>::infinity();
};

struct SmokeSetup {
    double dissipation_1_s = 0.0;  ///< exponential decay rate of the density
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

struct SolverSetup {
    Method method = Method::CutCell;
    Advection advection = Advection::SemiLagrangian;
    int cycles = 2;          ///< multigrid V-cycles a step (CutCell)
    int jacobi_sweeps = 40;  ///< (Yang2009)
};

struct FluidSetup {
    glm::ivec3 cells{32};
    double cell_m = 0.005;  ///< h, edge of the cubic cell
    double density_kg_m3 = 1.2;
    glm::dvec3 velocity_m_s{0.0};  ///< everywhere at the start
    std::optional<SmokeSetup> smoke{};
    std::vector<SourceSetup> sources{};
    std::vector<BodySetup> bodies{};
    SolverSetup solver;
};

/// Where a body is and how it moves at the end of a step.
struct BodyState {
    glm::dvec3 centre_m{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 velocity_m_s{0.0};
    glm::dvec3 spin_rad_s{0.0};
};

/// Force and torque (about the body's centre) ON the body BY the fluid, Tank frame.
struct Load {
    glm::dvec3 force_n{0.0};
    glm::dvec3 torque_nm{0.0};
};

}  // namespace eddy::gles
