#include <algorithm>
#include <array>
#include <cmath>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Reciprocity = GlTest;

/// One row and column for each way a body can move: three of its velocity and three of its spin, body after body.
using Matrix = std::vector<std::vector<double>>;

void give(BodyState& state, std::size_t way, double speed) {
    (way < 3 ? state.velocity_m_s : state.spin_rad_s)[static_cast<int>(way % 3)] = speed;
}
double felt(const Load& load, std::size_t way) {
    return (way < 3 ? load.force_n : load.torque_nm)[static_cast<int>(way % 3)];
}

/// -F_i for unit motion j: rows are what is felt.
template <class Loads>
Matrix matrix(std::size_t bodies, double speed, const Loads& loads_of) {
    Matrix m(6 * bodies, std::vector<double>(6 * bodies));
    for (std::size_t j = 0; j < 6 * bodies; ++j) {
        std::vector<BodyState> motion(bodies);
        give(motion[j / 6], j % 6, speed);
        const std::vector<Load> loads = loads_of(motion);
        for (std::size_t i = 0; i < 6 * bodies; ++i) m[i][j] = -felt(loads[i / 6], i % 6) / speed;
    }
    return m;
}

/// Largest |m_ij - m_ji| over sqrt(m_ii m_jj), among the ways that the fluid resists at all.
double asymmetry(const Matrix& m) {
    double worst = 0.0;
    for (std::size_t i = 0; i < m.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            worst = std::max(worst, std::abs(m[i][j] - m[j][i]) / std::sqrt(m[i][i] * m[j][j]));
    return worst;
}
/// The largest entry off the diagonal on the same scale: were there none, symmetry would say nothing.
double coupling(const Matrix& m) {
    double most = 0.0;
    for (std::size_t i = 0; i < m.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            most = std::max(most, std::abs(m[i][j]) / std::sqrt(m[i][i] * m[j][j]));
    return most;
}

/// Impulse that starts bodies in a perfect fluid: the whole added-mass matrix of two bodies near each other and the walls.
Matrix added_mass(Gpu& gpu, int cycles, const std::vector<BodySetup>& bodies,
                  const std::vector<BodyState>& places) {
    FluidSetup s = unit_tank({17, 22, 13}, 0.0, Advection::SemiLagrangian, cycles);
    s.bodies = bodies;
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    return matrix(bodies.size(), 0.01, [&](std::vector<BodyState> states) {
        for (std::size_t i = 0; i < states.size(); ++i) {
            states[i].centre_m = places[i].centre_m;
            states[i].orientation = places[i].orientation;
        }
        fluid->reset();
        fluid->step(1.0, states, false);
        return fluid->wait_result().loads;
    });
}

TEST_F(Reciprocity, OfTheAddedMassOfTwoBricks) {
    // Identity B8.13. On the grid it holds to rounding when the pressure is solved: its equation is symmetric, and the
    // force on a body is the sum of pressures that its motion works against.
    const std::vector<BodySetup> bodies{BodySetup{Cuboid{{5.0, 3.0, 4.0}}},
                                        BodySetup{Cuboid{{3.0, 6.0, 4.0}}}};
    const std::vector<BodyState> places{
        {.centre_m = {6.2, 6.6, 5.1},
         .orientation = glm::angleAxis(0.5, glm::normalize(glm::dvec3(1.0, 0.4, 2.0)))},
        {.centre_m = {10.3, 13.8, 7.2},
         .orientation = glm::angleAxis(-0.7, glm::normalize(glm::dvec3(0.2, 1.0, 0.6)))}};
    const Matrix m = added_mass(gpu, 16, bodies, places);
    record("asymmetry", asymmetry(m));
    record("asymmetry_fast", asymmetry(added_mass(gpu, 2, bodies, places)));
    record("coupling", coupling(m));
    EXPECT_LT(asymmetry(m), 1e-4);
    EXPECT_GT(coupling(m), 0.1);
    for (std::size_t i = 0; i < m.size(); ++i) EXPECT_GT(m[i][i], 0.0) << i;
}

TEST_F(Reciprocity, OfTheAddedMassOfTwoBallsOffTheMiddle) {
    // A ball's spin moves no surface, so only its three velocities count.
    const std::vector<BodySetup> bodies{BodySetup{Sphere{2.8}}, BodySetup{Sphere{2.2}}};
    const std::vector<BodyState> places{{.centre_m = {5.1, 7.3, 6.2}}, {.centre_m = {9.2, 11.1, 7.7}}};
    const Matrix all = added_mass(gpu, 16, bodies, places);
    Matrix m(6, std::vector<double>(6));
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) m[i][j] = all[i / 3 * 6 + i % 3][j / 3 * 6 + j % 3];
    record("asymmetry", asymmetry(m));
    record("coupling", coupling(m));
    EXPECT_LT(asymmetry(m), 1e-4);
    EXPECT_GT(coupling(m), 0.05);
}

TEST_F(Reciprocity, OfTheResistanceOfABrickInCreepingFlow) {
    // The full 6 x 6 tensor of a turned brick off the middle of a no-slip tank that is no cube, flow steady.
    FluidSetup s = unit_tank({17, 22, 13}, 0.0, Advection::SemiLagrangian, 3);
    s.viscosity_pa_s = 1.0;
    s.solver.viscous_cycles = 2;
    for (WallSetup& wall : s.walls) wall.kind = WallKind::NoSlip;
    s.bodies = {BodySetup{Cuboid{{6.0, 4.0, 5.0}}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const Matrix m = matrix(1, 1e-5, [&](std::vector<BodyState> states) {
        states[0].centre_m = {7.2, 9.3, 6.1};
        states[0].orientation = glm::angleAxis(0.6, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
        fluid->reset();
        constexpr int kSteps = 16;
        std::vector<Load> loads;
        for (int i = 0; i < kSteps; ++i) {
            fluid->step(8.0, states, false);
            loads = fluid->wait_result().loads;
        }
        return loads;
    });
    record("asymmetry", asymmetry(m));
    record("coupling", coupling(m));
    EXPECT_LT(asymmetry(m), 1e-3);  // measured when the limit was set: 4e-5
    EXPECT_GT(coupling(m), 0.05);
}

}  // namespace
}  // namespace eddy::gles
