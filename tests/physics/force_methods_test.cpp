#include <algorithm>
#include <cmath>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

// The force on a body three ways: pressure and friction summed over its surface, the balance of momentum in a box around it,
// and the impulse that it gave to the faces it touches. Where they agree no reference is needed to trust them.
using ForceThreeWays = GlTest;

double spread(const glm::dvec3& surface, const ForceMethods& other) {
    return std::max({glm::distance(surface, other.box_n), glm::distance(surface, other.impulse_n),
                     glm::distance(other.box_n, other.impulse_n)});
}

/// Largest spread of a run over the rms force, of all bodies together.
struct Worst {
    double spread = 0.0, squares = 0.0;
    int count = 0;

    void add(const Fluid& fluid, const std::vector<Load>& loads) {
        const std::vector<ForceMethods> others = fluid.force_methods();
        ASSERT_EQ(others.size(), loads.size());
        for (std::size_t i = 0; i < loads.size(); ++i, ++count) {
            spread = std::max(spread, eddy::gles::spread(loads[i].force_n, others[i]));
            squares += glm::dot(loads[i].force_n, loads[i].force_n);
        }
    }
    double over_force() const { return spread / std::sqrt(squares / count); }
};

TEST_F(ForceThreeWays, AgreeToRoundingWithoutFriction) {
    // Whatever moves the fluid besides: a jet beside the bodies, gravity, two bodies that nearly touch, few cycles.
    for (const Advection advection : {Advection::SemiLagrangian, Advection::MacCormack}) {
        FluidSetup s = unit_tank({17, 22, 13}, 2.6, advection, 2);
        s.bodies.push_back(BodySetup{Cuboid{{4.0, 3.0, 5.0}}});
        s.gravity_m_s2 = {0.0, -0.1, 0.02};
        s.sources = {SourceSetup{
            .centre_m = {4.0, 13.0, 6.0}, .radius_m = 2.0, .velocity_m_s = glm::dvec3(0.5, -0.2, 0.1)}};
        s.force_methods = true;
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        std::vector<BodyState> states{
            {.centre_m = {6.2, 5.6, 5.7}, .velocity_m_s = {0.2, 0.5, 0.0}},
            {.centre_m = {9.3, 13.0, 6.6},
             .orientation = glm::angleAxis(0.6, glm::normalize(glm::dvec3(1.0, 2.0, 0.5))),
             .velocity_m_s = {-0.1, 0.15, 0.1},
             .spin_rad_s = {0.05, -0.04, 0.08}}};
        Worst worst;
        for (int n = 0; n < 5; ++n) {
            for (BodyState& state : states) state.centre_m += state.velocity_m_s;
            fluid->step(1.0, states, false);
            worst.add(*fluid, fluid->wait_result().loads);
        }
        record(advection == Advection::MacCormack ? "spread_maccormack" : "spread_semi_lagrangian",
               worst.over_force());
        EXPECT_LT(worst.over_force(), 1e-5);
    }
}

/// A ball in a thick fluid and no-slip walls.
struct InThickFluid {
    int cycles, viscous_cycles;
    FluidSetup setup() const {
        FluidSetup s = unit_tank({18, 16, 17}, 3.4, Advection::SemiLagrangian, cycles);
        s.viscosity_pa_s = 0.5;
        s.solver.viscous_cycles = viscous_cycles;
        for (WallSetup& wall : s.walls) wall.kind = WallKind::NoSlip;
        s.force_methods = true;
        return s;
    }
    /// Spread from step `from` to the last.
    double spread(Gpu& gpu, const FluidSetup& s, BodyState state, double dt, bool glides, int from,
                  int last) const {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        Worst worst;
        for (int n = 1; n <= last; ++n) {
            if (glides) state.centre_m += dt * state.velocity_m_s;
            fluid->step(dt, {state}, false);
            const std::vector<Load> loads = fluid->wait_result().loads;
            if (n >= from) worst.add(*fluid, loads);
        }
        return worst.over_force();
    }
};
const BodyState kGlider{
    .centre_m = {7.3, 8.1, 8.6}, .velocity_m_s = {0.05, 0.02, -0.03}, .spin_rad_s = {0.0, 0.02, 0.01}};

TEST_F(ForceThreeWays, AgreeInASteadyCreepingFlow) {
    const InThickFluid well{6, 6}, fast{2, 1};
    const double spread = well.spread(gpu, well.setup(), kGlider, 4.0, false, 25, 25);
    record("spread", spread);
    record("spread_fast", fast.spread(gpu, fast.setup(), kGlider, 4.0, false, 25, 25));
    EXPECT_LT(spread, 1e-3);
}

TEST_F(ForceThreeWays, AgreeBesideALidThatSlides) {
    // Friction on the lid is part of the balance: the lid's formula must be known to it.
    const InThickFluid well{6, 6};
    FluidSetup s = well.setup();
    s.walls[3].velocity_m_s.glsl[0] = "0.02 + 0.001 * z";
    s.walls[3].velocity_at = [](const glm::dvec3& x, double) {
        return glm::dvec3(0.02 + 0.001 * x.z, 0.0, 0.0);
    };
    const double spread = well.spread(gpu, s, {.centre_m = {8.2, 11.3, 8.6}}, 4.0, false, 25, 25);
    record("spread", spread);
    EXPECT_LT(spread, 1e-3);
}

TEST_F(ForceThreeWays, DifferByTheSplittingWhileABallSetsOffInAThickFluid) {
    // The pressure that the surface feels is corrected by - nu div u** (add_pressure.frag), the momentum is not: the two see
    // a sudden start a step apart. Three steps later it is forgotten.
    const InThickFluid well{10, 10}, fast{2, 1};
    const double start = well.spread(gpu, well.setup(), kGlider, 1.0, true, 1, 3);
    const double later = well.spread(gpu, well.setup(), kGlider, 1.0, true, 6, 9);
    record("spread_start", start);
    record("spread_start_fast", fast.spread(gpu, fast.setup(), kGlider, 1.0, true, 1, 3));
    record("spread", later);
    record("spread_fast", fast.spread(gpu, fast.setup(), kGlider, 1.0, true, 6, 9));
    EXPECT_LT(start, 0.1);
    EXPECT_LT(later, 0.01);
}

TEST_F(ForceThreeWays, SayWhatTheTransportLoses) {
    // Nothing in an even stream, which is carried as it is; something where the flow varies from cell to cell.
    FluidSetup s = unit_tank({16, 12, 14}, 0.0, Advection::SemiLagrangian, 8);
    s.walls[0].kind = s.walls[1].kind = WallKind::Open;
    s.bodies = {BodySetup{Sphere{2.5}}};
    s.force_methods = true;
    s.velocity_at_start = [](const glm::dvec3&) { return glm::dvec3(0.4, 0.0, 0.0); };
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    // Going with the stream, so that nothing is disturbed.
    BodyState state{.centre_m = {6.4, 6.0, 7.0}, .velocity_m_s = {0.4, 0.0, 0.0}};
    fluid->step(1.0, {state}, false);
    const glm::dvec3 even = fluid->force_methods()[0].transport_n;
    EXPECT_LT(glm::length(even), 1e-4);
    state.velocity_m_s = glm::dvec3(0.0);
    for (int n = 0; n < 3; ++n) fluid->step(1.0, {state}, false);
    const glm::dvec3 disturbed = fluid->force_methods()[0].transport_n;
    record("lost_n", disturbed.x);
    EXPECT_GT(glm::length(disturbed), 0.1);
}

}  // namespace
}  // namespace eddy::gles
