#include <algorithm>
#include <cmath>
#include <numbers>

#include "gles/body/bounds.h"
#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using FreeBody = GlTest;

constexpr int kCells = 24;
const BodyState kMiddle{.centre_m = glm::dvec3(0.5 * kCells)};

/// A tank of n^3 cells of 1 m, water of 1 kg/m3, gravity 1 m/s2, and a free body that starts in the middle.
FluidSetup well(const Shape& shape, double density, double viscosity = 0.0, int n = kCells) {
    FluidSetup s = unit_tank(glm::ivec3(n), 0.0, Advection::SemiLagrangian, 3);
    s.gravity_m_s2 = {0.0, -1.0, 0.0};
    s.viscosity_pa_s = viscosity;
    s.bodies = {BodySetup{.shape = shape, .coupled = Coupled{.density_kg_m3 = density}}};
    return s;
}

TEST_F(FreeBody, SetsOffWithItsWeightLessBuoyancyOverItsMassAndAddedMass) {
    // C_m in the middle of a cubic tank with slip walls, radius / edge = 0.15 (method of fundamental solutions); 0.2 is
    // validation case B10.
    constexpr double kAddedMass = 0.52493;
    for (const double ratio : {0.01, 0.1, 2.0}) {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, well(Sphere{4.8}, ratio, 0.0, 32));
        const double dt = 0.05;
        fluid->step(dt, {{.centre_m = glm::dvec3(16.0)}}, false);
        const glm::dvec3 acceleration = fluid->bodies()[0].velocity_m_s / dt;
        const double exact = -(ratio - 1.0) / (ratio + kAddedMass);
        record(fmt::format("a_{}", ratio).c_str(), acceleration.y / exact);
        EXPECT_NEAR(acceleration.y, exact, 0.03 * std::abs(exact));
        EXPECT_LT(std::abs(acceleration.x) + std::abs(acceleration.z), 1e-3 * std::abs(exact));
    }
}

TEST_F(FreeBody, ChangesItsMomentumByTheForceOfTheFluidAndItsWeight) {
    // Newton's law, step by step and to rounding, while a light ball speeds up and glides over the cells.
    const double ratio = 0.1, dt = 0.1;
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, well(Sphere{3.6}, ratio));
    const double mass = ratio * 4.0 / 3.0 * std::numbers::pi * std::pow(3.6, 3);
    glm::dvec3 before(0.0);
    double weight = 0.0;
    for (int i = 0; i < 20; ++i) {
        fluid->step(dt, {kMiddle}, true);
        const glm::dvec3 now = fluid->bodies()[0].velocity_m_s;
        const StepResult result = fluid->wait_result();
        const glm::dvec3 force = result.loads[0].force_n;
        EXPECT_LT(result.diagnostics->divergence_max_1_s, 1e-3 * glm::length(now)) << "the fluid makes way";
        const glm::dvec3 rest = mass * (now - before) / dt - force;
        weight = std::max(weight, std::abs(rest.y + mass));
        EXPECT_LT(std::abs(rest.x) + std::abs(rest.z), 1e-4 * mass);
        before = now;
    }
    // A body weighs what its density makes of the fluid it displaces on the grid, which is not quite its volume.
    record("weight_error", weight / mass);
    EXPECT_LT(weight, 0.002 * mass);
}

TEST_F(FreeBody, GoesTheSameWayInStepsOfDifferentLengths) {
    // Newton's law in each step, and after 2 s the speed that even steps lead to.
    const double ratio = 0.1, mass = ratio * 4.0 / 3.0 * std::numbers::pi * std::pow(3.6, 3);
    const auto speed = [&](const std::vector<double>& steps_s) {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, well(Sphere{3.6}, ratio));
        glm::dvec3 before(0.0);
        for (int round = 0; round < 4; ++round)
            for (const double dt : steps_s) {
                fluid->step(dt, {kMiddle}, false);
                const glm::dvec3 now = fluid->bodies()[0].velocity_m_s;
                const glm::dvec3 rest = mass * (now - before) / dt - fluid->wait_result().loads[0].force_n;
                EXPECT_NEAR(rest.y, -mass, 0.002 * mass) << "dt " << dt;
                EXPECT_LT(std::abs(rest.x) + std::abs(rest.z), 1e-3 * mass) << "dt " << dt;
                before = now;
            }
        return before.y;
    };
    const double even = speed({0.1, 0.1, 0.1, 0.1, 0.1}), uneven = speed({0.2, 0.02, 0.03, 0.15, 0.1});
    record("speed_uneven_over_even", uneven / even);
    EXPECT_NEAR(uneven, even, 0.02 * even);
}

TEST_F(FreeBody, RisesWithoutEverTurningBackWhenItIsLight) {
    // A hundred times lighter than the fluid, and far lighter than its added mass: in water, syrup and tar.
    for (const double viscosity : {0.0, 1.0, 1000.0}) {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, well(Sphere{3.6}, 0.01, viscosity));
        double speed = 0.0, height = kMiddle.centre_m.y;
        for (int i = 0; i < (viscosity > 0.0 ? 15 : 30); ++i) {
            fluid->step(0.1, {kMiddle}, true);
            const BodyState& ball = fluid->bodies()[0];
            EXPECT_GT(ball.velocity_m_s.y, 0.9 * speed) << "viscosity " << viscosity << ", step " << i;
            EXPECT_GE(ball.centre_m.y, height);
            speed = ball.velocity_m_s.y;
            EXPECT_LT(fluid->wait_result().diagnostics->divergence_max_1_s, 3e-3 * speed)
                << "viscosity " << viscosity << ", step " << i;
            height = ball.centre_m.y;
        }
        record(fmt::format("speed_{}", viscosity).c_str(), speed);
    }
}

TEST_F(FreeBody, StaysWhereItIsWhenItWeighsWhatTheWaterDoes) {
    for (const Shape& shape : {Shape(Sphere{3.6}), Shape(Cuboid{{4.0, 6.0, 3.0}})}) {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, well(shape, 1.0));
        const BodyState start{.centre_m = {12.2, 11.7, 12.4},
                              .orientation = glm::angleAxis(0.5, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)))};
        for (int i = 0; i < 30; ++i) fluid->step(0.1, {start}, false);
        // Falling for these 3 s it would come 4.5 cells far.
        const double strayed = glm::distance(fluid->bodies()[0].centre_m, start.centre_m);
        record("strayed", strayed);
        EXPECT_LT(strayed, 1e-3);
    }
}

TEST_F(FreeBody, FallsWithTheSpeedAtWhichStokesDragCarriesItsWeight) {
    // A ball of radius 0.2 L in the middle of a no-slip cube meets 3.12346 times Stokes' drag (Stokeslets, method of fundamental
    // solutions).
    FluidSetup setup = well(Sphere{4.8}, 1.01, 100.0);
    setup.solver.viscous_cycles = 3;
    for (WallSetup& wall : setup.walls) wall.kind = WallKind::NoSlip;
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    for (int i = 0; i < 40; ++i) fluid->step(0.1, {kMiddle}, false);
    const double excess = 0.01 * 4.0 / 3.0 * std::numbers::pi * std::pow(4.8, 3);
    const double exact = excess / (6.0 * std::numbers::pi * 100.0 * 4.8 * 3.12346);
    const double speed = -fluid->bodies()[0].velocity_m_s.y;
    record("speed_over_exact", speed / exact);
    // The drag of so small a ball is 3.4 % low (B3 on 24^3 cells).
    EXPECT_NEAR(speed, exact, 0.05 * exact);
}

TEST_F(FreeBody, IsStoppedByTheWallsAndStaysThere) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, well(Sphere{3.6}, 5.0));
    for (int i = 0; i < 70; ++i) fluid->step(0.1, {kMiddle}, false);
    const BodyState& ball = fluid->bodies()[0];
    EXPECT_NEAR(ball.centre_m.y, 4.6, 1e-9) << "one cell above the floor";
    EXPECT_NEAR(ball.velocity_m_s.y, 0.0, 1e-7);
}

TEST_F(FreeBody, IsTurnedNoFasterThanAStepCanFollow) {
    // Layers of fluid that cross the tank five times in a step, one way above and the other below, and a light rod across them.
    constexpr double kDt = 0.1;
    FluidSetup setup = well(Capsule{1.5, 6.0}, 0.01, 0.0, 16);
    setup.velocity_at_start = [](const glm::dvec3& x) {
        return glm::dvec3(0.0, 0.0, 5.0 * 16.0 / kDt * (x.y / 8.0 - 1.0));
    };
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    double fastest = 0.0;
    for (int i = 0; i < 3; ++i) {
        fluid->step(kDt, {{.centre_m = glm::dvec3(8.0)}}, false);
        const BodyState& rod = fluid->bodies()[0];
        fastest = std::max({fastest, bounding_radius_m(setup.bodies[0].shape) * glm::length(rod.spin_rad_s),
                            glm::length(rod.velocity_m_s)});
    }
    record("longest_sides_a_step", fastest * kDt / 16.0);
    EXPECT_LE(fastest * kDt, 16.0 * (1.0 + 1e-9));
    EXPECT_GT(fastest * kDt, 8.0) << "something turns it";
}

TEST_F(FreeBody, ComesToLieOnTheFloorWhenItIsALongRod) {
    // Twelve cells of the tank's 16 long, let go leaning: the ball around it would be stopped at once.
    FluidSetup setup = well(Capsule{1.5, 9.0}, 5.0, 0.0, 16);
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    const BodyState leaning{.centre_m = glm::dvec3(8.0),
                            .orientation = glm::angleAxis(glm::radians(65.0), glm::dvec3(0.0, 0.0, 1.0))};
    double lowest = 8.0;
    for (int i = 0; i < 100; ++i) {
        fluid->step(0.1, {leaning}, false);
        lowest = std::min(lowest, fluid->bodies()[0].centre_m.y);
        EXPECT_LT(glm::length(fluid->bodies()[0].velocity_m_s), 3.0) << "step " << i;
    }
    const BodyState& rod = fluid->bodies()[0];
    record("height_at_last", rod.centre_m.y);
    EXPECT_NEAR(lowest, 2.5, 0.05) << "one cell above the floor";
    EXPECT_NEAR(rod.centre_m.y, 2.5, 0.05) << "and stays";
    EXPECT_LT(std::abs((rod.orientation * glm::dvec3(0.0, 1.0, 0.0)).y), 0.03);
}

TEST_F(FreeBody, IsMovedOutOfAnotherItIsPutInto) {
    FluidSetup setup = well(Sphere{3.6}, 0.01);
    setup.bodies.push_back(setup.bodies[0]);
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    for (int i = 0; i < 30; ++i) {
        fluid->step(0.1, {kMiddle, {.centre_m = {14.0, 13.5, 12.0}}}, false);
        const std::vector<BodyState>& balls = fluid->bodies();
        EXPECT_GT(glm::distance(balls[0].centre_m, balls[1].centre_m), 8.2 - 1e-3);
        for (const BodyState& ball : balls)
            EXPECT_LT(glm::length(ball.velocity_m_s), 4.5) << "step " << i;  // all the way, in empty space: 5
    }
}

TEST_F(FreeBody, IsPushedAheadByAHandAndSqueezedAgainstAWallWithoutHarm) {
    FluidSetup setup = well(Sphere{2.5}, 0.5);
    setup.gravity_m_s2 = glm::dvec3(0.0);
    setup.bodies.push_back({.shape = Sphere{2.5}});
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    BodyState hand{.centre_m = {5.0, 12.0, 12.0}, .velocity_m_s = {2.0, 0.0, 0.0}};
    for (int i = 0; i < 45; ++i) {
        hand.centre_m.x += 0.2;
        fluid->step(0.1, {{.centre_m = {11.5, 12.0, 12.0}}, hand}, false);
        EXPECT_LT(glm::length(fluid->bodies()[0].velocity_m_s), 8.0) << "step " << i;
    }
    // 14 is as far as the hand got; the ball was squeezed out to a side or lies between it and the wall.
    const glm::dvec3 ball = fluid->bodies()[0].centre_m;
    EXPECT_LE(ball.x, 20.5 + 1e-9);
    EXPECT_GT(glm::distance(ball, hand.centre_m), 5.0);
}

TEST_F(FreeBody, CostsAFixedOneNothing) {
    FluidSetup setup = well(Sphere{3.6}, 0.1);
    setup.bodies[0].coupled.reset();
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    std::vector<PassRecord> records;
    gpu.record(&records);
    fluid->step(0.1, {kMiddle}, false);
    gpu.record(nullptr);
    for (const PassRecord& record : records) EXPECT_NE(record.stage, "coupling");
}

}  // namespace
}  // namespace eddy::gles
