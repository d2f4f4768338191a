#include "firmware/accuracy/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "firmware/input_error.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::accuracy {
namespace {

/// Two grids, 10 and 20 cells, and what was measured on them.
std::vector<Row> rows(double coarse, double fine) {
    std::vector<Row> two(2);
    two[0] = {.cells = glm::ivec3(10), .cell_m = 0.1, .readings = {{.measured = coarse}}};
    two[1] = {.cells = glm::ivec3(20), .cell_m = 0.05, .readings = {{.measured = fine}}};
    return two;
}

std::vector<Row> judged(const Quantity& quantity, double coarse, double fine) {
    std::vector<Row> two = rows(coarse, fine);
    judge({.quantities = {quantity}}, two);
    return two;
}

const Quantity kPi{.name = "pi", .exact = 3.0, .error = Quantity::Error::Relative, .limits = {{20, 0.01}}};

TEST(Study, JudgesAnErrorWhereItsLimitHoldsAndOnFinerGrids) {
    const std::vector<Row> two = judged(kPi, 3.3, 3.027);
    EXPECT_EQ(two[0].readings[0].verdict, Verdict::Unjudged);
    EXPECT_NEAR(two[0].readings[0].error, 0.1, 1e-12);
    EXPECT_EQ(two[1].readings[0].verdict, Verdict::Met);
    EXPECT_EQ(judged(kPi, 3.3, 3.033)[1].readings[0].verdict, Verdict::Missed);
    EXPECT_EQ(limit_on(kPi, 19), std::nullopt);
    EXPECT_EQ(limit_on(kPi, 64), 0.01);
}

TEST(Study, CountsAnErrorToEitherSideAndMissesWhatIsNotANumber) {
    EXPECT_EQ(judged(kPi, 3.3, 2.967)[1].readings[0].verdict, Verdict::Missed);
    EXPECT_EQ(judged(kPi, 3.3, std::nan(""))[1].readings[0].verdict, Verdict::Missed);
}

TEST(Study, CountsOnlyWhatIsLackingWhereMoreIsNoFault) {
    Quantity quantity = kPi;
    quantity.error = Quantity::Error::Shortfall;
    const std::vector<Row> more = judged(quantity, 2.9, 3.5);
    EXPECT_NEAR(more[0].readings[0].error, 0.1, 1e-12);
    EXPECT_EQ(more[1].readings[0].error, 0.0);
    EXPECT_EQ(more[1].readings[0].verdict, Verdict::Met);
    EXPECT_EQ(judged(quantity, 2.9, 2.98)[1].readings[0].verdict, Verdict::Missed);
    EXPECT_EQ(judged(quantity, 2.9, std::nan(""))[1].readings[0].verdict, Verdict::Missed);
}

TEST(Study, JudgesTheOrderOnTheFinestGridOnly) {
    Quantity quantity = kPi;
    quantity.limits.clear();
    quantity.least_order = 1.9;
    const std::vector<Row> good = judged(quantity, 3.04, 3.01);
    EXPECT_NEAR(good[1].readings[0].order.value(), 2.0, 1e-9);
    EXPECT_EQ(good[1].readings[0].verdict, Verdict::Met);
    EXPECT_EQ(good[0].readings[0].verdict, Verdict::Unjudged);
    EXPECT_EQ(judged(quantity, 3.02, 3.01)[1].readings[0].verdict, Verdict::Missed);
}

TEST(Study, SaysOfAnEstimateWhetherItCoversTheErrorBeforeIt) {
    // pi is 10 % and 1 % off.
    for (const auto& [estimate, covers] : {std::pair(0.011, true), std::pair(0.009, false)}) {
        std::vector<Row> two = rows(3.3, 3.03);
        two[0].readings.push_back({.measured = 0.0});
        two[1].readings.push_back({.measured = estimate});
        judge({.quantities = {kPi, {.name = "guess", .estimates_error = true}}}, two);
        EXPECT_EQ(two[0].readings[1].covers, false);
        EXPECT_EQ(two[1].readings[1].covers, covers);
        EXPECT_EQ(two[1].readings[1].verdict, Verdict::Unjudged);
        EXPECT_FALSE(two[1].readings[1].order);
        EXPECT_FALSE(two[1].readings[0].covers);
    }
}

TEST(Study, TakesAWholeNumberOfStepsNearTheRule) {
    // B2-box: 4 steps on 60 cells.
    Case one = *cases_named("B2-box").front();
    EXPECT_DOUBLE_EQ(scene_on_grid(one, 30).solver.dt_s, 0.005);
    one.time_step = TimeStep::Courant;
    EXPECT_DOUBLE_EQ(scene_on_grid(one, 30).solver.dt_s, 0.01);
    EXPECT_DOUBLE_EQ(scene_on_grid(one, 45).solver.dt_s, 0.02 / 3.0);
    one.time_step = TimeStep::Diffusion;
    EXPECT_DOUBLE_EQ(scene_on_grid(one, 30).solver.dt_s, 0.02);
    EXPECT_DOUBLE_EQ(scene_on_grid(one, 120).solver.dt_s, 0.00125);
    EXPECT_EQ(scene_on_grid(one, 30).tank.cells, glm::ivec3(30));
}

TEST(Study, TakesAWholeNumberOfStepsForEachPartOnAnyGrid) {
    // B5: a swing and a half in 48 steps on 34 cells; B5-start: forces at a quarter, a half and the end of 32.
    for (int cells = 20; cells <= 70; ++cells)
        for (const auto& [name, part_s] :
             {std::pair("B5-glycerine", 0.25), std::pair("B5-start", 0.08922379 / 4.0)}) {
            const double steps = part_s / scene_on_grid(*cases_named(name).front(), cells).solver.dt_s;
            EXPECT_NEAR(steps, std::round(steps), 1e-9) << name << " on " << cells;
        }
}

TEST(Study, RefusesAGridThatDoesNotFillTheTankWithCubes) {
    EXPECT_THROW(scene_on_grid(*cases_named("B1-shapes").front(), 65), InputError);
}

TEST(Study, RunsACaseOnEachGridCoarsestFirstAndCountsItsSteps) {
    Case one = *cases_named("B2-box").front();
    one.quantities = {{.name = "dt [s]", .exact = 0.005, .error = Quantity::Error::Relative}};
    one.measure = [](Laboratory& lab) {
        accuracy::Run run = lab.start();
        run.step_to_end();
        return std::vector<double>{run.dt_s()};
    };
    const Study made = study(gles::shared_gpu(), one, {16, 8, 16});
    ASSERT_EQ(made.rows.size(), 2u);
    EXPECT_EQ(made.rows[0].cells, glm::ivec3(8));
    EXPECT_EQ(made.rows[1].cells, glm::ivec3(16));
    for (const Row& row : made.rows) {
        EXPECT_EQ(row.steps, 4);
        EXPECT_GT(row.step_ms, 0.0);
        EXPECT_GE(row.total_s, 2e-3 * row.step_ms);  // two of the four took the median or longer
        EXPECT_DOUBLE_EQ(row.readings.at(0).measured, 0.005);
    }
    one.quantities.clear();
    EXPECT_THROW(study(gles::shared_gpu(), one, {8}), std::logic_error);
}

}  // namespace
}  // namespace eddy::accuracy
