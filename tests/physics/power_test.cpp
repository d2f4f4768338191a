#include <algorithm>
#include <cmath>
#include <numbers>

#include "gles/fluid/face_shares.h"
#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Power = GlTest;

/// What the fluid does on the bodies in a second, F.U + T.W.
double power(const std::vector<Load>& loads, const std::vector<BodyState>& states) {
    double sum = 0.0;
    for (std::size_t i = 0; i < loads.size(); ++i)
        sum += glm::dot(loads[i].force_n, states[i].velocity_m_s) +
               glm::dot(loads[i].torque_nm, states[i].spin_rad_s);
    return sum;
}

TEST_F(Power, OfThePushThatStartsABodyIsHalfKineticEnergyAndHalfLost) {
    // Identity B8.3 for one step from rest. The body has its whole velocity at once, so its work F.U dt is twice the
    // energy that the flow then has: sum a u^2 = -F.U dt, exactly, since both are sums of the same pressure differences.
    for (const int cycles : {16, 2}) {
        FluidSetup s = unit_tank({17, 22, 13}, 0.0, Advection::SemiLagrangian, cycles);
        s.bodies = {BodySetup{Cuboid{{5.0, 4.0, 6.0}}}, BodySetup{Sphere{2.4}}};
        const std::vector<BodyState> states{
            {.centre_m = {8.3, 7.2, 6.4},
             .orientation = glm::angleAxis(0.5, glm::normalize(glm::dvec3(1.0, 1.0, 0.3))),
             .velocity_m_s = {0.3, -0.1, 0.2},
             .spin_rad_s = {0.1, 0.05, -0.08}},
            {.centre_m = {9.1, 15.6, 6.9}, .velocity_m_s = {-0.1, 0.2, 0.1}, .spin_rad_s = {0.0, 0.3, 0.0}}};
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        const double dt = 0.5;
        fluid->step(dt, states, false);
        const double work = -dt * power(fluid->wait_result().loads, states);
        const double twice_energy = sum_of_squares(face_shares(gpu, s, states), fluid->velocity());
        record(cycles == 2 ? "twice_energy_over_work_fast" : "twice_energy_over_work", twice_energy / work);
        EXPECT_NEAR(twice_energy / work, 1.0, cycles == 2 ? 5e-3 : 1e-4) << cycles << " cycles";
    }
}

TEST_F(Power, TakenFromTheFluidIsNeverMoreThanWasPutIn) {
    // A ball swings, is stopped, and is swung again through what is left of the flow. Work that it did on the fluid less
    // kinetic energy is what was lost; it may only grow, but for what rounding and an unsolved pressure leave.
    for (const Advection advection : {Advection::SemiLagrangian, Advection::MacCormack}) {
        const bool fast = advection == Advection::SemiLagrangian;
        for (const int cycles : {12, fast ? 2 : 3}) {
            FluidSetup s = unit_tank({25, 18, 21}, 3.4, advection, cycles);
            const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
            const double dt = 1.0;
            const auto x_at = [](double t) {
                const double swing = std::sin(2.0 * std::numbers::pi * t / 16.0);
                return 12.3 + (t <= 16.0 ? 2.5 * swing : t <= 24.0 ? 0.0 : -1.5 * swing);
            };
            double work = 0.0, lost = 0.0, gained_back = 0.0, most_energy = 0.0;
            for (int n = 1; n <= 40; ++n) {
                const double x = x_at(n * dt), v = (x - x_at((n - 1) * dt)) / dt;
                const std::vector<BodyState> states{
                    {.centre_m = {x, 9.2, 10.4}, .velocity_m_s = {v, 0.0, 0.0}}};
                fluid->step(dt, states, false);
                work -= dt * power(fluid->wait_result().loads, states);
                const double energy = 0.5 * sum_of_squares(face_shares(gpu, s, states), fluid->velocity());
                most_energy = std::max(most_energy, energy);
                gained_back = std::max(gained_back, lost - (work - energy));
                lost = std::max(lost, work - energy);
            }
            const std::string name =
                std::string(fast ? "semi_lagrangian" : "maccormack") + (cycles == 12 ? "" : "_preset");
            record((name + "_lost_over_energy").c_str(), lost / most_energy);
            record((name + "_gained_back").c_str(), gained_back / most_energy);
            EXPECT_GT(lost, 0.0);
            EXPECT_LT(gained_back, 0.01 * most_energy) << name;
        }
    }
}

}  // namespace
}  // namespace eddy::gles
