#include "firmware/stability/matrix.h"

#include <gmock/gmock.h>

#include <set>

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
    for (const Cell& cell : cells) all.push_back(result_of(cell, {}));
    Result again = all[2];
    again.outcome.steps = 7;
    const std::vector<std::vector<Result>> parts{{all[1], all[3]}, {all[0], all[2]}, {again}};
    const std::vector<Result> together = merged(cells, parts);
    ASSERT_EQ(together.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(together[i].is_of(cells[i]));
    EXPECT_EQ(together[2].outcome.steps, 7);
    EXPECT_EQ(merged(cells, std::vector<std::vector<Result>>{{all[1]}}).size(), 1u);
}

TEST(HardMatrix, SmallGridsAndWhatWasRedComeFirst) {
    const std::vector<Cell> cells =
        cells_of({.cases = {"stall+cup", "stall", "jitter"}, .grids = {"9", "8"}});
    ASSERT_EQ(cells.size(), 10u);
    std::vector<std::string> order;
    for (const std::size_t i : telling_first(cells, std::vector{a_result("jitter", false)}))
        order.push_back(cells[i].name() + " " + grid_name(cells[i].trial.cells));
    const std::vector<std::string> wanted{"jitter 8^3",    "jitter 8^3",   "stall 8^3",  "stall 8^3",
                                          "stall+cup 8^3", "jitter 9^3",   "jitter 9^3", "stall 9^3",
                                          "stall 9^3",     "stall+cup 9^3"};
    EXPECT_EQ(order, wanted);
}

TEST(HardMatrix, ItsReportNamesWhatIsRedAndWhyAndWhatWasNotRun) {
    const std::vector<Cell> cells = cells_of({.cases = {"stall", "jitter", "grid-9^3"}, .grids = {"8", "9"}});
    const std::vector<Result> results{a_result("stall", true), a_result("jitter", false)};
    const std::string report = report_of(cells, results, "a renderer", "a machine", {"folder/heat_map.png"});
    EXPECT_THAT(report, HasSubstr("| 2 | jitter | 8^3 | least | step 3: a \"bad\", long reason |"));
    EXPECT_THAT(report, HasSubstr("- `jitter`: nobody has found out why yet."));
    EXPECT_THAT(report, HasSubstr("1 of 2 (8 more not run) cells of single cases"));
    EXPECT_THAT(report, HasSubstr("| 2 | stall | not run | green | not run | not run |  |"));
    EXPECT_THAT(report,
                HasSubstr("| 27 | grid-9^3 |  |  |  |  | 9^3 default: not run, 9^3 least: not run |"));
    EXPECT_THAT(report, HasSubstr("| half, at least | 2026-11-22, 0.1 |"));
    EXPECT_THAT(report, HasSubstr("](heat_map.png)"));
    EXPECT_THAT(table_line(results[1]), HasSubstr("RED"));
    EXPECT_THAT(report_of(cells, std::vector{a_result("covers-all", false)}, "a renderer", "a machine", {}),
                HasSubstr("- `covers-all`: what flows in behind a lid"));
    EXPECT_THAT(heat_map_of(results, "folder").commands, HasSubstr("'jitter' 1"));
}

}  // namespace
}  // namespace eddy::stability
