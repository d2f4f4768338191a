#include <gtest/gtest.h>

#include "gles/fluid/fluid.h"
#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using Reset = GlTest;

/// All that a run leaves behind.
struct Outcome {
    std::vector<glm::vec3> velocity;
    std::vector<float> pressure, temperature;
    std::vector<glm::dvec3> centres, forces;

    bool operator==(const Outcome&) const = default;
};

/// Six steps, of two lengths, with a ball that moves.
Outcome run(Fluid& fluid) {
    Outcome outcome;
    BodyState ball{.centre_m = {7.0, 8.0, 9.0}, .velocity_m_s = {0.4, 0.0, 0.0}};
    for (int i = 0; i < 6; ++i) {
        const double dt = i < 3 ? 0.5 : 0.25;
        ball.centre_m.x += dt * ball.velocity_m_s.x;
        fluid.step(dt, {ball}, false);
        outcome.centres.push_back(fluid.bodies()[0].centre_m);
        outcome.forces.push_back(fluid.wait_result().loads[0].force_n);
    }
    outcome.velocity = fluid.velocity();
    outcome.pressure = fluid.pressure();
    if (const Field<Cells>* t = fluid.temperature())
        outcome.temperature = unpack_scalars(t->texture().download(), t->layout());
    return outcome;
}

/// A tank in units of cells with a ball in it, gravity, and a jet.
FluidSetup tank() {
    FluidSetup s;
    s.cells = glm::ivec3(16);
    s.cell_m = 1.0;
    s.density_kg_m3 = 1.0;
    s.gravity_m_s2 = {0.0, -1.0, 0.0};
    s.bodies = {BodySetup{Sphere{3.0}}};
    s.sources = {
        SourceSetup{.centre_m = {4.0, 4.0, 4.0}, .radius_m = 2.0, .velocity_m_s = glm::dvec3(1.0, 0.5, 0.2)}};
    return s;
}

/// A run, a reset and the run again give what a fluid gives that has never done anything.
void expect_back_at_the_start(Gpu& gpu, const FluidSetup& setup) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    const Outcome first = run(*fluid);
    fluid->reset();
    EXPECT_EQ(fluid->steps(), 0);
    EXPECT_TRUE(fluid->bodies().empty());
    const Outcome again = run(*fluid), fresh = run(*make_fluid(gpu, setup));
    EXPECT_TRUE(again == fresh) << "the run after the reset";
    EXPECT_TRUE(first == fresh) << "the one before it";
}

TEST_F(Reset, OfAViscousFluidIsExact) {
    FluidSetup s = tank();
    s.viscosity_pa_s = 0.5;
    expect_back_at_the_start(gpu, s);
}

TEST_F(Reset, OfAHeatedFluidIsExact) {
    FluidSetup s = tank();
    s.temperature = TemperatureSetup{
        .expansion_1_k = 0.1, .diffusivity_m2_s = 0.3, .at_start_k = [](const glm::dvec3& x) { return x.x; }};
    s.sources[0].temperature_k_per_s = 1.0;
    expect_back_at_the_start(gpu, s);
}

TEST_F(Reset, OfAFluidThatCarriesABodyIsExact) {
    for (const double viscosity : {0.0, 0.5})
        for (const Shape& shape : {Shape(Sphere{3.0}), Shape(Cuboid{{4.0, 6.0, 3.0}})}) {
            FluidSetup s = tank();
            s.viscosity_pa_s = viscosity;
            s.bodies = {BodySetup{.shape = shape, .coupled = Coupled{.density_kg_m3 = 0.3}}};
            expect_back_at_the_start(gpu, s);
        }
}

TEST_F(Reset, OfAFluidOfSecondOrderInTimeIsExact) {
    FluidSetup s = tank();
    s.solver.time_order = 2;
    s.solver.advection = Advection::MacCormack;
    expect_back_at_the_start(gpu, s);
}

}  // namespace
}  // namespace eddy::gles
