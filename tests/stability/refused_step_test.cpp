#include <cmath>
#include <limits>

#include "tests/gles/gl_fixture.h"
#include "tests/stability/fluid_inside.h"

namespace eddy::gles {

/// What googletest writes for one; it looks in the namespace of what it writes.
static void PrintTo(Method method, std::ostream* out) {
    *out << (method == Method::CutCell ? "CutCell" : "Yang2009");
}

namespace {

FluidSetup tank(Method method) {
    FluidSetup s;
    s.cells = glm::ivec3(16);
    s.cell_m = 0.01;
    s.shortest_step_s = 2e-5;
    s.longest_step_s = 0.1;
    s.bodies = {BodySetup{Sphere{0.025}}};
    s.solver.method = method;
    return s;
}

BodyState ball(int n) {
    return {.centre_m = {0.06 + 0.002 * n, 0.08, 0.08}, .velocity_m_s = {0.1, 0.0, 0.0}};
}

class RefusedStep : public GlTest, public testing::WithParamInterface<Method> {};

TEST_P(RefusedStep, LeavesAllAsItIsAndAnswersAsBefore) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, tank(GetParam())),
                                 plain = make_fluid(gpu, tank(GetParam()));
    for (int n = 1; n <= 3; ++n) {
        plain->step(0.02, {ball(n)}, false);
        const StepResult expected = plain->wait_result();
        fluid->step(0.02, {ball(n)}, false);
        EXPECT_EQ(fluid->wait_result().loads[0].force_n, expected.loads[0].force_n);
        for (const double dt : {0.0, 1e-9, std::numeric_limits<double>::quiet_NaN()}) {
            fluid->step(dt, {ball(n + 7)}, false);
            const StepResult again = fluid->wait_result();
            EXPECT_EQ(again.step, n);
            EXPECT_EQ(again.loads[0].force_n, expected.loads[0].force_n) << dt;
            EXPECT_EQ(fluid->bodies()[0].centre_m, ball(n).centre_m);
        }
    }
    EXPECT_EQ(fluid->velocity(), plain->velocity());
    EXPECT_EQ(fluid->steps(), 3);
    EXPECT_EQ(fluid->guards().step_refused, 9);
    EXPECT_FALSE(fluid->result(true)) << "more answers than steps";
}

TEST_P(RefusedStep, BeforeTheFirstAnswersThatThereIsNoForce) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, tank(GetParam()));
    fluid->step(0.0, {ball(1)}, false);
    const StepResult answer = fluid->wait_result();
    ASSERT_EQ(answer.loads.size(), 1u);
    EXPECT_EQ(answer.loads[0].force_n, glm::dvec3(0.0));
}

TEST_P(RefusedStep, WaitsItsTurnBehindStepsUnderWay) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, tank(GetParam()));
    fluid->step(0.02, {ball(1)}, false);
    fluid->step(0.0, {ball(1)}, false);
    EXPECT_EQ(fluid->wait_result().step, 1);
    EXPECT_EQ(fluid->wait_result().step, 1);
    EXPECT_FALSE(fluid->result(true));
}

TEST_P(RefusedStep, AStepOfAnyLengthAndABodyFromAnywhereLeaveNumbers) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, tank(GetParam()));
    const double inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
    const double lengths[] = {0.02, 250.0, 1e-7, 0.02, 1e30, nan, 0.02, 0.1, 3e-5, 0.02};
    const BodyState bodies[] = {ball(1),
                                {.centre_m = glm::dvec3(nan)},
                                {.centre_m = glm::dvec3(1e300)},
                                {.centre_m = {-1e9, 0.08, 0.08}},
                                {.centre_m = glm::dvec3(0.08), .orientation = {1e200, 1e200, 0.0, 0.0}},
                                {.centre_m = glm::dvec3(0.08), .velocity_m_s = glm::dvec3(1e30)},
                                {.centre_m = glm::dvec3(0.08), .spin_rad_s = glm::dvec3(inf)},
                                {.centre_m = glm::dvec3(0.08), .spin_rad_s = glm::dvec3(1e20)}};
    for (const double dt : lengths)
        for (const BodyState& body : bodies) {
            fluid->step(dt, {body}, false);
            EXPECT_TRUE(is_finite(fluid->wait_result().loads[0])) << dt;
        }
    EXPECT_EQ(not_finite(*fluid), 0);
}

using FormulaTest = GlTest;

// Division by a constant 0 never gets here (config/formula_parser.cpp).
TEST_F(FormulaTest, WithoutAValueSaysNothing) {
    const VectorFormula at_run_time{{"sqrt(x - 1.0)", "log(-1.0 - y)", "sqrt(-1.0 - z)"}},
        of_constants{{"sqrt((-1.0))", "log((-1.0))", "(0.0 * log(0.0))"}};
    for (const auto& [kind, none] :
         {std::pair(WallKind::NoSlip, at_run_time), std::pair(WallKind::Inflow, of_constants)}) {
        FluidSetup setup = tank(Method::CutCell);
        setup.viscosity_pa_s = 0.1;
        setup.walls[0] = {.kind = kind, .velocity_m_s = none};
        setup.walls[1] = {.kind = WallKind::Open};
        setup.acceleration_m_s2 = none;
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
        for (int n = 1; n <= 3; ++n) {
            fluid->step(0.02, {ball(n)}, false);
            EXPECT_TRUE(fluid->wait_result().is_sound()) << none.glsl[0] << ", step " << n;
        }
        EXPECT_EQ(not_finite(*fluid), 0) << none.glsl[0];
    }
}

INSTANTIATE_TEST_SUITE_P(Of, RefusedStep, testing::Values(Method::CutCell, Method::Yang2009),
                         [](const auto& tested) { return testing::PrintToString(tested.param); });

}  // namespace
}  // namespace eddy::gles
