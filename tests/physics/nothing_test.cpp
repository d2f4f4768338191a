#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

// Where no fluid touches a body there is nothing to feel, exactly: identity B8.12.
using Nothing = GlTest;

TEST_F(Nothing, IsFeltByABodyOutsideTheTankNorDoesTheFluidFeelIt) {
    for (const double viscosity : {0.0, 1.0}) {
        FluidSetup s = unit_tank({17, 13, 15}, 2.0, Advection::SemiLagrangian, 2);
        s.viscosity_pa_s = viscosity;
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        for (const glm::dvec3& place : {glm::dvec3(40.0, 6.0, 7.0), glm::dvec3(-9.0, 6.0, 7.0)}) {
            fluid->step(
                0.1,
                {BodyState{
                    .centre_m = place, .velocity_m_s = {1.0, 0.0, 0.0}, .spin_rad_s = {0.5, 1.0, -2.0}}},
                false);
            const Load load = fluid->wait_result().loads[0];
            EXPECT_EQ(load.force_n, glm::dvec3(0.0)) << "viscosity " << viscosity;
            EXPECT_EQ(load.torque_nm, glm::dvec3(0.0)) << "viscosity " << viscosity;
        }
        for (const glm::vec3& u : fluid->velocity()) ASSERT_EQ(u, glm::vec3(0.0f));
    }
}

TEST_F(Nothing, IsFeltByABodyThatLeavesNoRoomForAnyFluid) {
    for (const double viscosity : {0.0, 1.0}) {
        FluidSetup s = unit_tank({9, 8, 11}, 20.0, Advection::MacCormack, 3);
        s.viscosity_pa_s = viscosity;
        s.gravity_m_s2 = {0.0, -9.81, 0.0};
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        for (int i = 0; i < 3; ++i) {
            fluid->step(0.1, {BodyState{.centre_m = {4.5, 4.0, 5.5}, .spin_rad_s = {0.0, 1.0, 0.0}}}, false);
            const Load load = fluid->wait_result().loads[0];
            EXPECT_EQ(load.force_n, glm::dvec3(0.0)) << "viscosity " << viscosity;
            EXPECT_EQ(load.torque_nm, glm::dvec3(0.0)) << "viscosity " << viscosity;
        }
    }
}

}  // namespace
}  // namespace eddy::gles
