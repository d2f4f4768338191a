#include <GLES3/gl3.h>

#include <cmath>
#include <stdexcept>

#include "gles/fluid/fluid.h"
#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using TakeOver = GlTest;

/// A tank 16 m wide with a ball in it and a jet of smoke.
FluidSetup tank(int cells, Method method = Method::CutCell) {
    FluidSetup s;
    s.cells = glm::ivec3(cells);
    s.cell_m = 16.0 / cells;
    s.density_kg_m3 = 1.0;
    s.solver.method = method;
    s.smoke = SmokeSetup{};
    s.bodies = {BodySetup{Sphere{3.0}}};
    s.sources = {SourceSetup{.centre_m = {4.0, 4.0, 4.0},
                             .radius_m = 2.0,
                             .velocity_m_s = glm::dvec3(1.0, 0.5, 0.2),
                             .smoke_per_s = 1.0}};
    return s;
}

/// The ball of step n, of two lengths.
double dt_of(long n) {
    return n % 8 < 5 ? 0.5 : 0.25;
}
BodyState ball_of(long n) {
    return {.centre_m = {7.0 + 0.15 * static_cast<double>(n), 8.0, 9.0}, .velocity_m_s = {0.4, 0.0, 0.0}};
}
void advance(Fluid& fluid, int steps) {
    for (int i = 0; i < steps; ++i)
        fluid.step(dt_of(fluid.steps()),
                   std::vector<BodyState>(fluid.setup().bodies.size(), ball_of(fluid.steps())), false);
}

/// All that a run leaves behind.
struct StateAfter {
    std::vector<glm::vec3> velocity;
    std::vector<float> pressure, smoke, temperature;
    std::vector<glm::dvec3> centres, forces;
    std::vector<long> steps;

    bool operator==(const StateAfter&) const = default;
};

std::vector<float> values(const Field<Cells>* s) {
    return s ? unpack_scalars(s->texture().download(), s->layout()) : std::vector<float>();
}

StateAfter carry_on(Fluid& fluid) {
    StateAfter outcome;
    for (int i = 0; i < 4; ++i) {
        advance(fluid, 1);
        for (const BodyState& body : fluid.bodies()) outcome.centres.push_back(body.centre_m);
        for (const ForceMethods& force : fluid.force_methods())
            outcome.forces.insert(outcome.forces.end(), {force.box_n, force.impulse_n, force.transport_n});
        if (fluid.setup().imposed) continue;
        const StepResult result = fluid.wait_result();
        outcome.steps.push_back(result.step);
        outcome.forces.push_back(result.loads[0].force_n);
    }
    outcome.velocity = fluid.velocity();
    if (!fluid.setup().imposed) outcome.pressure = fluid.pressure();
    outcome.smoke = values(fluid.smoke());
    outcome.temperature = values(fluid.temperature());
    return outcome;
}

/// A twin that takes over, whether it is new or has run otherwise before, goes on as the fluid itself does.
void expect_twin_goes_on(Gpu& gpu, const FluidSetup& setup) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup), fresh = make_fluid(gpu, setup),
                                 used = make_fluid(gpu, setup);
    for (int i = 0; i < 3; ++i)
        used->step(0.3, std::vector<BodyState>(setup.bodies.size(), BodyState{.centre_m = {9.0, 5.0, 6.0}}),
                   false);
    advance(*fluid, 3);
    while (!setup.imposed && fluid->result(true)) {
    }
    fresh->take_over(*fluid);
    used->take_over(*fluid);
    EXPECT_EQ(used->steps(), 3);
    const StateAfter itself = carry_on(*fluid);
    EXPECT_TRUE(carry_on(*fresh) == itself) << "a new one";
    EXPECT_TRUE(carry_on(*used) == itself) << "one that had run before";
}

TEST_F(TakeOver, FromATwinGoesOnAsTheTwinWould) {
    expect_twin_goes_on(gpu, tank(16));
}

TEST_F(TakeOver, FromATwinThatIsViscousIsExact) {
    FluidSetup s = tank(16);
    s.viscosity_pa_s = 0.5;
    expect_twin_goes_on(gpu, s);
    s.force_methods = true;
    expect_twin_goes_on(gpu, s);
}

TEST_F(TakeOver, FromATwinThatIsHeatedIsExact) {
    FluidSetup s = tank(16);
    s.gravity_m_s2 = {0.0, -1.0, 0.0};
    s.temperature = TemperatureSetup{
        .expansion_1_k = 0.1, .diffusivity_m2_s = 0.3, .at_start_k = [](const glm::dvec3& x) { return x.x; }};
    s.sources[0].temperature_k_per_s = 1.0;
    expect_twin_goes_on(gpu, s);
}

TEST_F(TakeOver, FromATwinOfSecondOrderInTimeIsExact) {
    FluidSetup s = tank(16);
    s.solver.time_order = 2;
    s.solver.advection = Advection::MacCormack;
    expect_twin_goes_on(gpu, s);
}

TEST_F(TakeOver, FromATwinThatCarriesABodyIsExact) {
    for (const double viscosity : {0.0, 0.5})
        for (const Shape& shape : {Shape(Sphere{3.0}), Shape(Cuboid{{4.0, 6.0, 3.0}})}) {
            FluidSetup s = tank(16);
            s.gravity_m_s2 = {0.0, -1.0, 0.0};
            s.viscosity_pa_s = viscosity;
            s.bodies = {BodySetup{.shape = shape, .coupled = Coupled{.density_kg_m3 = 0.3}}};
            SCOPED_TRACE(viscosity);
            SCOPED_TRACE(shape.index());
            expect_twin_goes_on(gpu, s);
        }
}

TEST_F(TakeOver, FromATwinOfTheMethodOf2009IsExact) {
    FluidSetup s = tank(16, Method::Yang2009);
    s.viscosity_pa_s = 0.5;
    expect_twin_goes_on(gpu, s);
}

TEST_F(TakeOver, FromATwinInAnImposedFlowIsExact) {
    FluidSetup s = tank(16);
    s.bodies = {};
    s.temperature =
        TemperatureSetup{.diffusivity_m2_s = 0.3, .at_start_k = [](const glm::dvec3& x) { return x.x; }};
    s.imposed = ImposedSetup{.velocity_m_s = {{"0.3 * cos(t)", "0.1", "0.0"}}};
    expect_twin_goes_on(gpu, s);
}

/// Of every kind, on grids of all sorts.
std::vector<FluidSetup> all_kinds() {
    FluidSetup precise = tank(24), viscous = tank(16), odd_yang = tank(17, Method::Yang2009);
    precise.solver.advection = Advection::MacCormack;
    viscous.viscosity_pa_s = odd_yang.viscosity_pa_s = 0.5;
    return {tank(15), precise, viscous, tank(16, Method::Yang2009), odd_yang};
}

TEST_F(TakeOver, KeepsAUniformFlowAndUniformSmokeToTheLastBit) {
    // Before the first step, which would know of walls.
    const glm::vec3 u(0.3f, -1.7f, 0.1f);
    for (FluidSetup from : all_kinds())
        for (FluidSetup to : all_kinds()) {
            from.smoke->at_start = [](const glm::dvec3&) { return 0.7; };
            const std::unique_ptr<Fluid> source = make_fluid(gpu, from), fluid = make_fluid(gpu, to);
            source->set_velocity(std::vector<glm::vec3>(source->velocity().size(), u));
            fluid->take_over(*source);
            for (const glm::vec3& v : fluid->velocity()) ASSERT_EQ(v, u);
            const float density = from.solver.method == Method::Yang2009 ? 0.0f : 0.7f;
            for (const float s : values(fluid->smoke())) ASSERT_EQ(s, density);
        }
}

TEST_F(TakeOver, StaysFiniteBetweenAnyTwoKindsOfFluid) {
    for (const FluidSetup& from : all_kinds())
        for (const FluidSetup& to : all_kinds()) {
            const std::unique_ptr<Fluid> source = make_fluid(gpu, from), fluid = make_fluid(gpu, to);
            advance(*source, 2);
            fluid->take_over(*source);
            EXPECT_EQ(fluid->steps(), 2);
            const StateAfter outcome = carry_on(*fluid);
            for (const glm::vec3& v : outcome.velocity) ASSERT_TRUE(std::isfinite(v.x + v.y + v.z));
            for (const float p : outcome.pressure) ASSERT_TRUE(std::isfinite(p));
            for (const float s : outcome.smoke) ASSERT_TRUE(std::isfinite(s));
            for (const glm::dvec3& f : outcome.forces) ASSERT_TRUE(std::isfinite(f.x + f.y + f.z));
            EXPECT_EQ(outcome.steps.front(), 3);
        }
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(TakeOver, LeavesAFreeBodyWhereItIsAndHowItMoves) {
    for (const Method method : {Method::CutCell, Method::Yang2009}) {
        FluidSetup s = tank(16), other = tank(24);
        s.gravity_m_s2 = other.gravity_m_s2 = {0.0, -1.0, 0.0};
        s.bodies = other.bodies = {
            BodySetup{.shape = Cuboid{{4.0, 6.0, 3.0}}, .coupled = Coupled{.density_kg_m3 = 0.3}}};
        s.solver.method = method;
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s), finer = make_fluid(gpu, other);
        advance(*fluid, 4);
        finer->take_over(*fluid);
        EXPECT_EQ(finer->bodies()[0].centre_m, fluid->bodies()[0].centre_m);
        EXPECT_EQ(finer->bodies()[0].velocity_m_s, fluid->bodies()[0].velocity_m_s);
        EXPECT_EQ(finer->bodies()[0].orientation, fluid->bodies()[0].orientation);
        EXPECT_EQ(finer->bodies()[0].spin_rad_s, fluid->bodies()[0].spin_rad_s);
    }
}

TEST_F(TakeOver, MakesNothingMoreWhenItIsDoneAgainAndAgain) {
    Gpu own(gpu.capabilities());
    std::vector<std::unique_ptr<Fluid>> fluids;
    for (const FluidSetup& setup : all_kinds()) fluids.push_back(make_fluid(own, setup));
    std::size_t made = 0, bytes = 0;
    Fluid* now = fluids[0].get();
    for (int i = 0; i < 20; ++i)
        for (const std::unique_ptr<Fluid>& next : fluids) {
            advance(*now, 1);
            next->take_over(*now);
            now = next.get();
            if (i < 2) {
                made = own.textures().made();
                bytes = own.textures().bytes();
            }
        }
    EXPECT_EQ(own.textures().made(), made);
    EXPECT_EQ(own.textures().bytes(), bytes);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(TakeOver, RefusesAnotherTankOrOtherBodies) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, tank(16));
    FluidSetup longer = tank(16), empty = tank(16), imposed = tank(16);
    longer.cells.y = 17;
    empty.bodies = {};
    imposed.imposed = ImposedSetup{};
    for (const FluidSetup& other : {longer, empty, imposed})
        EXPECT_THROW(fluid->take_over(*make_fluid(gpu, other)), std::logic_error);
}

}  // namespace
}  // namespace eddy::gles
