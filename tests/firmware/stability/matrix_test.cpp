#include "firmware/stability/matrix.h"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "firmware/built_from.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/report.h"
#include "tests/firmware/stability/complaint.h"

namespace eddy::stability {
namespace {

using testing::HasSubstr;

TEST(HardMatrix, QuickIsASmallPartOfFull) {
    std::set<std::string> full;
    for (const Cell& cell : cells_of({.extent = Extent::Full}))
        EXPECT_TRUE(
            full.insert(cell.name() + grid_name(cell.trial.cells) + std::string(to_word(cell.trial.effort)))
                .second)
            << cell.name();
    const std::vector<Cell> quick = cells_of({.extent = Extent::Quick});
    for (const Cell& cell : quick)
        EXPECT_TRUE(full.contains(cell.name() + grid_name(cell.trial.cells) +
                                  std::string(to_word(cell.trial.effort))) ||
                    cell.cases.size() == 2)
            << cell.name();
    EXPECT_LT(10 * quick.size(), full.size());
}

TEST(HardMatrix, FullHasEveryPairOfCasesThatAreNotTooLong) {
    std::size_t single = 0, pairs = 0;
    for (const Case& one : all_cases())
        single += !one.alone && one.grids.empty() && !one.full_only && one.steps <= 1500;
    for (const Cell& cell : cells_of({.extent = Extent::Full}))
        pairs += cell.cases.size() == 2 && cell.trial.cells == glm::ivec3(25);
    EXPECT_EQ(pairs, single * (single - 1) / 2);
}

TEST(HardMatrix, ACaseIsTriedOnTheGridsThatAreAskedFor) {
    const std::vector<Cell> cells = cells_of({.cases = {"stall", "stall+cup"}, .grids = {"9", "8x8x16"}});
    ASSERT_EQ(cells.size(), 6u);  // two efforts for one case, one for two
    EXPECT_EQ(cells[0].trial, (Trial{glm::ivec3(9), Effort::Default}));
    EXPECT_EQ(cells[3].trial, (Trial{glm::ivec3(8, 8, 16), Effort::Least}));
    EXPECT_EQ(cells[5].name(), "stall+cup");
    EXPECT_EQ(cells_of({.cases = {"27"}, .grids = {"8", "9", "10"}}).size(), 4u)
        << "a case about grids has its own";
    EXPECT_THAT(complaint_about([] { cells_of({.cases = {"4+cup"}}); }), HasSubstr("4 is several cases"));
    EXPECT_THAT(complaint_about([] { cells_of({.cases = {"jacobi-stopped-early+cup"}}); }),
                HasSubstr("alone"));
}

Result a_result(const char* name, bool pass) {
    return {2,
            name,
            "8^3",
            "least",
            {500,
             {pass, pass ? "" : "step 3: a \"bad\", long reason", 0.5, 1e-5, 0.25, 0},
             "half, at least",
             1.5},
            "2026-11-22, 0.1"};
}

TEST(HardMatrix, ItsCsvReadsBack) {
    const std::vector<Result> results{a_result("stall", true), a_result("jitter", false)};
    const std::string text = csv_of(results);
    const std::vector<Result> back = results_from_csv(text, "x.csv");
    ASSERT_EQ(back.size(), 2u);
    EXPECT_EQ(back[1].outcome.verdict.reason, results[1].outcome.verdict.reason);
    EXPECT_EQ(back[1].outcome.verdict.recovery_s, 0.25);
    EXPECT_EQ(back[1].outcome.remark, "half, at least");
    EXPECT_EQ(back[1].tried, "2026-11-22, 0.1");
    EXPECT_EQ(csv_of(back), text);
    EXPECT_EQ(complaint_about([&] { results_from_csv("nonsense", "x.csv"); }),
              "x.csv: is not what eddy stability writes");
    EXPECT_EQ(complaint_about([&] { results_from_csv(text + "4,cut,8^3\n", "x.csv"); }),
              "x.csv:4: is not what eddy stability writes");
}

TEST(HardMatrix, OfACellThatIsInSeveralPartsTheLastCounts) {
    const std::vector<Cell> cells = cells_of({.cases = {"2"}, .grids = {"8"}});
    std::vector<Result> all;
    for (const Cell& cell : cells) all.push_back(result_of(cell, {.steps = cell.all_steps()}));
    Result again = all[2];
    again.outcome.wall_s = 7.0;
    const std::vector<std::vector<Result>> parts{{all[1], all[3]}, {all[0], all[2]}, {again}};
    const std::vector<Result> together = merged(cells, parts);
    ASSERT_EQ(together.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(together[i].is_of(cells[i]));
    EXPECT_EQ(together[2].outcome.wall_s, 7.0);
    EXPECT_EQ(merged(cells, std::vector<std::vector<Result>>{{all[1]}}).size(), 1u);
}

TEST(HardMatrix, WhatWasGreenForFewStepsIsNotForMore) {
    const Order order{.cases = {"stall"}, .grids = {"8"}};
    const std::vector<Cell> cells = cells_of(order);
    Result least = a_result("stall", true);
    EXPECT_TRUE(find(std::vector{least}, cells[1]));
    least.outcome.steps = 100;
    EXPECT_FALSE(find(std::vector{least}, cells[1]));
    EXPECT_TRUE(merged(cells, std::vector<std::vector<Result>>{{least}}).empty());
    Order quick = order;
    quick.extent = Extent::Quick;
    EXPECT_TRUE(find(std::vector{least}, cells_of(quick)[1])) << "as many as were asked for";
    Result red = a_result("stall", false);
    red.outcome.steps = 3;
    EXPECT_TRUE(find(std::vector{red}, cells[1])) << "what was red for few steps is red";
}

/// What a case does to a trial of so many steps, in words; without the fluid.
std::set<std::string> happens_in(const Case& one, long steps) {
    const Trial trial{glm::ivec3(8), Effort::Least};
    Scene scene = common_scene(trial);
    if (one.change) one.change(scene);
    const double dt_s = scene.solver.dt_s;
    std::set<std::string> all;
    for (long step = 0; step < steps; ++step) {
        Moment m{.step = step, .time_s = dt_s * static_cast<double>(step), .scene = &scene, .dt_s = dt_s};
        m.calm_from_s = dt_s * static_cast<double>(steps) * (1.0 - one.calm_share);
        m.hand_m = m.middle_m();
        if (one.script) one.script(m);
        if (!(m.dt_s > 0.1 * dt_s && m.dt_s < 10.0 * dt_s)) all.insert(fmt::format("lasts {}", m.dt_s));
        for (const Fault& fault : m.faults)
            all.insert(fmt::format("fault {} {} {}", static_cast<int>(fault.place), fault.value,
                                   static_cast<int>(fault.extent)));
        if (m.reset) all.insert("reset");
        if (m.holds_answer) all.insert("holds its answer");
        if (m.flow) all.insert("flow");
        if (m.change_preset) all.insert("preset");
        const glm::dvec3 away = (m.hand_m - m.middle_m()) / (0.5 * scene.tank.size_m);
        for (int c = 0; c < 3; ++c)
            if (std::abs(away[c]) > 1.0)
                all.insert(fmt::format("{} beyond wall {}", std::abs(away[c]) > 1e9 ? "infinitely" : "just",
                                       2 * c + (away[c] > 0.0)));
    }
    return all;
}

TEST(HardMatrix, WhatHappensInACaseHappensInItsQuickCellAsWell) {
    for (const Cell& cell : cells_of({.extent = Extent::Quick}))
        for (const Case* one : cell.cases)
            EXPECT_EQ(happens_in(*one, cell.steps()), happens_in(*one, one->steps)) << cell.name();
}

TEST(HardMatrix, AQuickCellIsLongEnoughToLevelOff) {
    for (const Cell& cell : cells_of({.extent = Extent::Quick})) {
        const Case& one = *cell.cases[0];
        if (cell.cases.size() > 1 || (one.wants.find("drift") == std::string::npos &&
                                      one.wants.find("levels off") == std::string::npos))
            continue;
        EXPECT_GE(one.least_steps, kLevelSteps) << one.name;
        EXPECT_TRUE(cell.steps() >= kLevelSteps || cell.steps() < one.least_steps)
            << one.name << ": or it says that it is not judged";
    }
}

TEST(HardMatrix, SaysWhereCalmIsNotJudged) {
    const std::vector<Cell> cells = cells_of({.extent = Extent::Quick, .cases = {"stall", "piston"}});
    std::vector<Result> results;
    for (const Cell& cell : cells) results.push_back(result_of(cell, {.steps = cell.all_steps()}));
    EXPECT_THAT(summary_of(cells, results), HasSubstr("not judged in 4 of them: calm 5 s"))
        << "quick ones end before";
    const std::vector<Cell> whole = cells_of({.cases = {"stall"}, .grids = {"8"}});
    results.clear();
    for (const Cell& cell : whole) results.push_back(result_of(cell, {.steps = cell.all_steps()}));
    EXPECT_THAT(summary_of(whole, results), testing::Not(HasSubstr("not judged")));
}

TEST(HardMatrix, ACaseThatCalmsDownDoesSoForAsLongAsTheRuleWaits) {
    for (const Case& one : all_cases()) {
        EXPECT_TRUE(one.calm_share == 0.0 || one.calm_s == 0.0) << one.name;
        if (one.calm_share == 0.0 && one.calm_s == 0.0) continue;
        const Case* const alone[] = {&one};
        EXPECT_GE(plan_of(alone, {glm::ivec3(8), Effort::Least}, one.steps).calm_s, kCalmS - 1e-6)
            << one.name;
    }
}

TEST(HardMatrix, OfTheFullMatrixGridsAreSelected) {
    for (const Cell& cell : cells_of({.extent = Extent::Full, .grids = {"64"}})) {
        EXPECT_EQ(cell.trial.cells, glm::ivec3(64));
        EXPECT_EQ(cell.cases.size(), 1u) << cell.name() << ": pairs are tried on 25^3";
        EXPECT_FALSE(cell.cases.front()->small_only) << cell.name();
    }
}

TEST(HardMatrix, SingleCasesSmallGridsAndWhatWasRedComeFirst) {
    const std::vector<Cell> cells =
        cells_of({.cases = {"stall+cup", "stall", "jitter"}, .grids = {"9", "8"}});
    ASSERT_EQ(cells.size(), 10u);
    std::vector<std::string> order;
    for (const std::size_t i : telling_first(cells, std::vector{a_result("jitter", false)}))
        order.push_back(cells[i].name() + " " + grid_name(cells[i].trial.cells));
    const std::vector<std::string> wanted{"jitter 8^3",    "jitter 8^3",   "stall 8^3", "stall 8^3",
                                          "jitter 9^3",    "jitter 9^3",   "stall 9^3", "stall 9^3",
                                          "stall+cup 8^3", "stall+cup 9^3"};
    EXPECT_EQ(order, wanted);
}

TEST(HardMatrix, ItsReportNamesWhatIsRedAndWhyAndWhatWasNotRun) {
    const std::vector<Cell> cells = cells_of({.cases = {"stall", "jitter", "grid-9^3"}, .grids = {"8", "9"}});
    const std::vector<Result> results{a_result("stall", true), a_result("jitter", false)};
    const std::string report = report_of(cells, results, "a renderer", "a machine", {"folder/heat_map.png"});
    EXPECT_THAT(report, HasSubstr("| 2 | jitter | 8^3 | least | step 3: a \"bad\", long reason † |"));
    EXPECT_THAT(report, HasSubstr("- `jitter`: nobody has found out why yet."));
    EXPECT_THAT(report, HasSubstr("1 of 2 (8 more not run) cells of single cases"));
    EXPECT_THAT(report, HasSubstr("| 2 | stall | not run | green | not run | not run |  |"));
    EXPECT_THAT(report,
                HasSubstr("| 27 | grid-9^3 |  |  |  |  | 9^3 default: not run, 9^3 least: not run |"));
    EXPECT_THAT(report, HasSubstr("| half, at least | 2026-11-22, 0.1 † |"));
    Result ours = a_result("stall", true);
    ours.tried = "2026-11-22, " + std::string(kBuiltFrom);
    EXPECT_THAT(report_of(cells, std::vector{ours}, "a renderer", "a machine", {}),
                HasSubstr("| " + ours.tried + " |\n"));
    EXPECT_THAT(report, HasSubstr("](heat_map.png)"));
    EXPECT_THAT(table_line(results[1]), HasSubstr("RED"));
    EXPECT_THAT(report_of(cells, std::vector{a_result("covers-all", false)}, "a renderer", "a machine", {}),
                HasSubstr("- `covers-all`: what flows in behind a lid"));
    EXPECT_THAT(heat_map_of(results, "folder").commands, HasSubstr("'jitter' 1"));
}

}  // namespace
}  // namespace eddy::stability
