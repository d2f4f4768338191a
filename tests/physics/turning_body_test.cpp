#include <cmath>
#include <numbers>

#include "gles/body/rigid_body.h"
#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using TurningBody = GlTest;

/// A tank of n^3 cells of 1 m, fluid of 1 kg/m3, and one body that the fluid turns, and moves unless it is held.
FluidSetup pool(const Shape& shape, double density, bool held, int n = 24) {
    FluidSetup s = unit_tank(glm::ivec3(n), 0.0, Advection::SemiLagrangian, 3);
    s.bodies = {BodySetup{.shape = shape,
                          .coupled = Coupled{.density_kg_m3 = density, .moves = !held, .turns = true}}};
    return s;
}

glm::dquat tilted(double angle_deg) {
    return glm::angleAxis(glm::radians(angle_deg), glm::dvec3(0.0, 0.0, 1.0));
}

/// Added mass along and across the axis, over the mass of the fluid in its place, and added moment of inertia about a line
/// across it, over that of the fluid: of a spheroid in unbounded fluid, half axis a > b (Lamb 1932, Hydrodynamics, 114, 373).
struct Spheroid {
    double along, across, turning;
};
Spheroid added(double a, double b) {
    const double e2 = 1.0 - b * b / (a * a), e = std::sqrt(e2), log = std::log((1.0 + e) / (1.0 - e));
    const double alpha = 2.0 * (1.0 - e2) / (e2 * e) * (0.5 * log - e);
    const double beta = 1.0 / e2 - (1.0 - e2) / (2.0 * e2 * e) * log;
    return {alpha / (2.0 - alpha), beta / (2.0 - beta),
            e2 * e2 * (beta - alpha) / ((2.0 - e2) * (2.0 * e2 - (2.0 - e2) * (beta - alpha)))};
}

TEST_F(TurningBody, SharesAnImpulseWithTheFluidAsLambsSpheroidDoes) {
    // A free spheroid, tilted in a fluid at rest, is given a velocity or a spin; in the first step the fluid takes its part.
    constexpr double kLong = 8.0, kShort = 4.0;
    const Spheroid c = added(kLong, kShort);
    const glm::dquat pose = tilted(30.0);
    const glm::dvec3 along = pose * glm::dvec3(0.0, 1.0, 0.0), across = pose * glm::dvec3(1.0, 0.0, 0.0);
    const auto kept = [&](const glm::dvec3& velocity, const glm::dvec3& spin) {
        const std::unique_ptr<Fluid> fluid =
            make_fluid(gpu, pool(Ellipsoid{{kShort, kLong, kShort}}, 1.0, false, 48));
        fluid->step(1e-3,
                    {{.centre_m = glm::dvec3(24.0),
                      .orientation = pose,
                      .velocity_m_s = velocity,
                      .spin_rad_s = spin}},
                    false);
        const BodyState& after = fluid->bodies()[0];
        return glm::dot(after.velocity_m_s, velocity) + glm::dot(after.spin_rad_s, spin);
    };
    const double kept_along = kept(along, glm::dvec3(0.0)), kept_across = kept(across, glm::dvec3(0.0));
    const double kept_turning = kept(glm::dvec3(0.0), {0.0, 0.0, 1.0});
    record("along", kept_along * (1.0 + c.along));
    record("across", kept_across * (1.0 + c.across));
    record("turning", kept_turning * (1.0 + c.turning));
    EXPECT_NEAR(kept_along, 1.0 / (1.0 + c.along), 0.02);
    EXPECT_NEAR(kept_across, 1.0 / (1.0 + c.across), 0.02);
    EXPECT_NEAR(kept_turning, 1.0 / (1.0 + c.turning), 0.02);
}

TEST_F(TurningBody, ChangesItsAngularMomentumByTheTorqueOfTheFluid) {
    const Shape shape = Cuboid{{4.0, 7.0, 3.0}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, pool(shape, 0.5, false));
    const RigidBody body(shape, 0.5);
    BodyState before{.centre_m = {12.2, 11.6, 12.1},
                     .orientation = tilted(20.0),
                     .velocity_m_s = {0.3, -0.2, 0.1},
                     .spin_rad_s = {0.1, 0.05, 0.3}};
    const double scale = body.momentum(before, before.orientation)[5];
    for (int i = 0; i < 15; ++i) {
        fluid->step(0.1, {before}, false);
        const BodyState now = fluid->bodies()[0];
        const Vector6 had = body.momentum(before, now.orientation), has = body.momentum(now, now.orientation);
        const Load load = fluid->wait_result().loads[0];
        for (int k = 0; k < 3; ++k) {
            const auto c = static_cast<std::size_t>(k);
            EXPECT_NEAR(has[c] - had[c], 0.1 * load.force_n[k], 1e-4 * scale);
            EXPECT_NEAR(has[c + 3] - had[c + 3], 0.1 * load.torque_nm[k], 1e-4 * scale);
        }
        before = now;
    }
    EXPECT_GT(glm::length(before.spin_rad_s), 0.05) << "it turns on";
}

TEST_F(TurningBody, DrawnThroughTheFluidTurnsBroadsideOn) {
    // A long body whose axis is 45 degrees off is turned square to its motion (Munk's moment), held or not by friction.
    for (const double viscosity : {0.0, 0.1}) {
        FluidSetup setup = pool(Ellipsoid{{2.5, 5.5, 2.5}}, 1.0, true);
        setup.viscosity_pa_s = viscosity;
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
        BodyState hand{
            .centre_m = {7.0, 12.0, 12.0}, .orientation = tilted(45.0), .velocity_m_s = {1.0, 0.0, 0.0}};
        double off = 45.0;
        for (int i = 0; i < (viscosity > 0.0 ? 20 : 50); ++i) {
            hand.centre_m.x += 0.2;
            fluid->step(0.2, {hand}, false);
            const BodyState& body = fluid->bodies()[0];
            EXPECT_EQ(body.centre_m, hand.centre_m);
            EXPECT_EQ(body.velocity_m_s, hand.velocity_m_s);
            const glm::dvec3 axis = body.orientation * glm::dvec3(0.0, 1.0, 0.0);
            const double now = glm::degrees(std::atan2(-axis.x, axis.y));
            EXPECT_LT(now, off + 0.5);
            off = now;
        }
        record(fmt::format("degrees_off_{}", viscosity).c_str(), off);
        EXPECT_LT(off, viscosity > 0.0 ? 42.0 : 10.0);
    }
}

TEST_F(TurningBody, InTheHandTipsOverIfItIsHeavyAndItsCentreOfMassIsNotInTheHand) {
    const Paddle paddle{{6.0, 6.0, 3.0}, 1.5, 4.0};
    for (const double density : {1.0, 3.0}) {
        FluidSetup setup = pool(paddle, density, true);
        setup.gravity_m_s2 = {0.0, -1.0, 0.0};
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
        for (int i = 0; i < 5; ++i)
            fluid->step(0.1, {{.centre_m = glm::dvec3(12.0), .orientation = tilted(60.0)}}, false);
        const double spin = fluid->bodies()[0].spin_rad_s.z;
        record(fmt::format("spin_{}", density).c_str(), spin);
        if (density == 1.0)
            EXPECT_NEAR(spin, 0.0, 1e-4) << "it weighs nothing in the fluid";
        else
            EXPECT_GT(spin, 0.01) << "its handle goes down";
    }
}

TEST_F(TurningBody, IsCarriedAlongByThickFluidThatTurns) {
    // A ball in the middle of a tank whose walls drag the fluid round: pressure cannot turn it, friction does.
    FluidSetup setup = pool(Sphere{4.0}, 1.0, false, 16);
    setup.viscosity_pa_s = 100.0;
    for (std::size_t wall = 0; wall < 6; ++wall) {
        setup.walls[wall].kind = WallKind::NoSlip;
        setup.walls[wall].velocity_m_s.glsl = {"-(y - 8.0)", "x - 8.0", "0.0"};
    }
    for (const std::size_t wall : {0u, 1u}) setup.walls[wall].velocity_m_s.glsl[0] = "0.0";
    for (const std::size_t wall : {2u, 3u}) setup.walls[wall].velocity_m_s.glsl[1] = "0.0";
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    for (int i = 0; i < 20; ++i) fluid->step(1.0, {{.centre_m = glm::dvec3(8.0)}}, false);
    const glm::dvec3 spin = fluid->bodies()[0].spin_rad_s;
    record("spin", spin.z);
    EXPECT_GT(spin.z, 0.3);
    EXPECT_LT(spin.z, 1.0);
    EXPECT_LT(std::abs(spin.x) + std::abs(spin.y), 0.01);
}

}  // namespace
}  // namespace eddy::gles
