#include "firmware/accuracy/sweep/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/accuracy/sweep/problem.h"
#include "firmware/input_error.h"

namespace eddy::accuracy::sweep {
namespace {

TEST(Plan, ShardsHoldEveryPointExactlyOnce) {
    for (const int shards : {1, 3, 8, 300})
        for (std::size_t point = 0; point < 200; ++point) {
            int holders = 0;
            for (int i = 1; i <= shards; ++i) holders += Shard{i, shards}.holds(point);
            ASSERT_EQ(holders, 1) << "point " << point << " of " << shards << " shards";
        }
}

TEST(Plan, ShardIsReadAsWritten) {
    EXPECT_EQ(parse_shard("3/8").number, 3);
    EXPECT_EQ(parse_shard("3/8").of, 8);
    for (const char* wrong : {"", "3", "3/", "/8", "3/8x", "x/8", "5/4", "0/4", "-1/4", "1/0", "1 / 4"})
        EXPECT_THROW(parse_shard(wrong), InputError) << wrong;
}

TEST(Plan, NoPointIsThereTwice) {
    for (const bool full : {false, true}) {
        const std::vector<Point> points = points_of({.full = full});
        for (auto point = points.begin(); point != points.end(); ++point)
            EXPECT_EQ(std::count(points.begin(), points.end(), *point), 1)
                << point->problem << " " << describe(point->setting);
    }
}

TEST(Plan, EveryPointCanBeRunAsAScene) {
    for (const Point& point : points_of({.full = true})) {
        const Problem& problem = problem_named(point.problem);
        const Scene scene = applied(load_scene(problem.of.scene, problem.of.set).scene, point.setting);
        EXPECT_NO_THROW(read_scene(print_scene(scene), "point"))
            << point.problem << " " << describe(point.setting);
    }
}

TEST(Plan, FullSweepHoldsTheQuickOnesUsualSettings) {
    const std::vector<Point> full = points_of({.full = true});
    const Point usual{"B2", {SolverPreset::Fast, 64, 2}};
    EXPECT_EQ(std::count(full.begin(), full.end(), usual), 1);
    EXPECT_TRUE(has_stages(usual));
    EXPECT_FALSE(has_stages({"B2", {SolverPreset::Fast, 64, 3}}));
    EXPECT_FALSE(has_stages({"B3", {SolverPreset::Fast, 64, 2}}));
}

TEST(Plan, CasesAndGridsNarrowIt) {
    const std::vector<Point> some = points_of({.cases = {"A1"}, .grids = {24}});
    ASSERT_FALSE(some.empty());
    for (const Point& point : some) {
        EXPECT_EQ(point.problem, "A1");
        EXPECT_EQ(point.setting.cells, 24);
    }
    EXPECT_THROW(points_of({.cases = {"A9"}}), InputError);
    EXPECT_THROW(points_of({.cases = {"A1"}, .grids = {25}}), InputError);  // a quarter of 25 is not whole
}

TEST(Plan, TimeStepIsAsManyTimesTheCasesAsAsked) {
    Scene scene;
    scene.outputs.duration_s = 1.0;
    scene.solver.dt_s = 0.1;
    scene.solver.cycles = 8;
    const Scene half = applied(scene, {SolverPreset::Yang2009, 32, 80, 0.5, ForceWay::Surface});
    EXPECT_DOUBLE_EQ(half.solver.dt_s, 0.05);
    EXPECT_EQ(half.solver.jacobi_sweeps, 80);
    EXPECT_FALSE(half.solver.cycles);
    EXPECT_DOUBLE_EQ(applied(scene, {SolverPreset::Fast, 32, 2, 3.0}).solver.dt_s,
                     1.0 / 3.0);  // not 0.3: whole steps
    EXPECT_TRUE(applied(scene, {SolverPreset::Fast, 32, 2, 1.0, ForceWay::Box}).outputs.force_methods);
}

}  // namespace
}  // namespace eddy::accuracy::sweep
