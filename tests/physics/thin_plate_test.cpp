#include <algorithm>
#include <cmath>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using ThinPlate = GlTest;

/// What flows, after so many steps, through a duct that a plate 0.3 cells thick blocks, as a share of what would flow without it: the fluid falls
/// along the duct, from one opening to the other.
double leak(Gpu& gpu, const glm::dvec3& centre, double tilt_deg, int cycles, int steps) {
    FluidSetup s = unit_tank({24, 16, 17}, 0.0, Advection::SemiLagrangian, cycles);
    s.walls[0].kind = s.walls[1].kind = WallKind::Open;
    s.acceleration_m_s2 = VectorFormula{{"1.0", "0.0", "0.0"}};
    s.bodies.push_back({Cuboid{{0.3, 80.0, 80.0}}});
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const BodyState plate{
        .centre_m = centre,
        .orientation = glm::angleAxis(glm::radians(tilt_deg), glm::normalize(glm::dvec3(0.0, 1.0, 1.0)))};
    constexpr double kDt = 0.01;
    for (int i = 0; i < steps; ++i) fluid->step(kDt, {plate}, false);
    const std::vector<glm::vec3> u = fluid->velocity();
    double flow = 0.0;
    for (int z = 0; z < s.cells.z; ++z)
        for (int y = 0; y < s.cells.y; ++y)
            flow += u[static_cast<std::size_t>((z * (s.cells.y + 1) + y) * (s.cells.x + 1) + 2)].x;
    return flow / (s.cells.y * s.cells.z * steps * kDt);
}

TEST_F(ThinPlate, LeaksLessThanAPercentWhereverItStandsAndHoweverItIsTilted) {
    for (const double tilt_deg : {0.0, 20.0, 45.0})
        for (const double offset : {0.0, 0.2, 0.5}) {
            const glm::dvec3 centre(12.0 + offset, 8.0 + 0.3 * offset, 8.5);
            const double at_once = leak(gpu, centre, tilt_deg, 8, 1),
                         soon = leak(gpu, centre, tilt_deg, 3, 6);
            record(tilt_deg == 0.0 ? "upright_at_once" : "tilted_at_once", at_once);
            record(tilt_deg == 0.0 ? "upright_soon" : "tilted_soon", soon);
            EXPECT_NEAR(at_once, 0.0, 0.01) << tilt_deg << " degrees, offset " << offset;
            EXPECT_NEAR(soon, 0.0, 0.01) << tilt_deg << " degrees, offset " << offset;
        }
}

/// The largest divergence that a first step of `cycles` leaves of what the falling fluid would have, for each place.
std::vector<double> left_over(Gpu& gpu, const glm::ivec3& n, double thickness, int cycles) {
    FluidSetup s = unit_tank(n, 0.0, Advection::SemiLagrangian, cycles);
    s.walls[0].kind = s.walls[1].kind = WallKind::Open;
    s.acceleration_m_s2 = VectorFormula{{"1.0", "0.0", "0.0"}};
    s.bodies.push_back({Cuboid{{thickness, 80.0, 80.0}}});
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    constexpr double kDt = 1e-3;
    std::vector<double> left;
    for (double x = 0.5 * n.x - 1.0; x < 0.5 * n.x + 3.0; x += 0.25) {
        fluid->reset();
        fluid->step(kDt, {BodyState{.centre_m = {x, 0.5 * n.y, 0.5 * n.z}}}, true);
        left.push_back(fluid->result(true)->diagnostics->divergence_max_1_s / kDt);
    }
    return left;
}

TEST_F(ThinPlate, LetsTheCyclesConvergeWhereverItStands) {
    // Measured when the limits were set: 0.885 at the worst place, 0.381 on average.
    double worst = 0.0, mean = 0.0;
    int places = 0;
    for (const glm::ivec3 n : {glm::ivec3(16, 12, 12), glm::ivec3(17, 12, 13), glm::ivec3(24, 12, 16)})
        for (const double thickness : {0.3, 0.7, 1.0, 2.0, 2.5}) {
            const std::vector<double> few = left_over(gpu, n, thickness, 1),
                                      many = left_over(gpu, n, thickness, 7);
            for (std::size_t i = 0; i < few.size(); ++i) {
                const double rate = std::pow(many[i] / few[i], 1.0 / 6.0);
                worst = std::max(worst, rate);
                mean += rate;
                ++places;
                EXPECT_LT(rate, 0.92) << thickness << " cells thick, " << n.x << " cells, place " << i;
            }
        }
    record("worst_rate", worst);
    record("mean_rate", mean / places);
    EXPECT_LT(mean / places, 0.42);
}

// Between open ends, all that holds the falling fluid is its friction along the plate. The half cells at the ends are not felt (traction.frag).
TEST_F(ThinPlate, CarriesTheWholeWeightOfAThickFluidWhereverItStands) {
    const glm::ivec3 n(16, 8, 9);
    FluidSetup s = unit_tank(n, 0.0, Advection::SemiLagrangian, 3);
    s.viscosity_pa_s = 20.0;
    s.walls[2].kind = s.walls[3].kind = WallKind::Open;
    s.acceleration_m_s2 = VectorFormula{{"0.0", "1e-6", "0.0"}};
    for (const double thickness : {0.3, 1.0, 2.0})
        for (const double offset : {0.0, 0.25, 0.5}) {
            s.bodies = {{Cuboid{{thickness, 80.0, 80.0}}}};
            const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
            constexpr int kSteps = 15;  // the slowest mode falls e-fold in 4 d^2 / (pi^2 nu) = 1.3 s
            for (int i = 0; i < kSteps; ++i)
                fluid->step(1.0, {BodyState{.centre_m = {8.0 + offset, 4.0, 4.5}}}, false);
            const double share =
                fluid->result(true)->loads[0].force_n.y / (1e-6 * (n.x - thickness) * (n.y - 1) * n.z);
            record("weight", share);
            EXPECT_NEAR(share, 1.0, 0.02) << thickness << " cells thick, offset " << offset;
        }
}

}  // namespace
}  // namespace eddy::gles
