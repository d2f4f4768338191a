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
    for (const Cell& cell : cells_of({.extent = Extent::Full})) pairs += cell.cases.size() == 2;
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
            {500, {pass, pass ? "" : "step 3: a \"bad\", long reason", 0.5, 1e-5, 0.25, 0}, 1.5}};
}

TEST(HardMatrix, ItsCsvReadsBack) {
    const std::vector<Result> results{a_result("stall", true), a_result("jitter", false)};
    const std::string text = csv_of(results);
    const std::vector<Result> back = results_from_csv(text, "x.csv");
    ASSERT_EQ(back.size(), 2u);
    EXPECT_EQ(back[1].outcome.verdict.reason, results[1].outcome.verdict.reason);
    EXPECT_EQ(back[1].outcome.verdict.recovery_s, 0.25);
    EXPECT_EQ(csv_of(back), text);
    EXPECT_EQ(complaint_about([&] { results_from_csv("nonsense", "x.csv"); }),
              "x.csv: is not what eddy stability writes");
    EXPECT_EQ(complaint_about([&] { results_from_csv(text + "4,cut,8^3\n", "x.csv"); }),
              "x.csv:4: is not what eddy stability writes");
}

TEST(HardMatrix, PartsAreMergedOnlyIfTheyAreAllThereOnce) {
    const std::vector<Cell> cells = cells_of({.cases = {"2"}, .grids = {"8"}});
    std::vector<Result> all;
    for (const Cell& cell : cells) all.push_back(result_of(cell, {}));
    const std::vector<std::vector<Result>> parts{{all[1], all[3]}, {all[0], all[2]}};
    const std::vector<Result> together = merged(cells, parts);
    ASSERT_EQ(together.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(together[i].is_of(cells[i]));
    const std::vector<std::vector<Result>> some{{all[1]}}, twice{all, {all[2]}};
    EXPECT_THAT(complaint_about([&] { merged(cells, some); }),
                HasSubstr("none of these folders holds stall on 8^3"));
    EXPECT_THAT(complaint_about([&] { merged(cells, twice); }), HasSubstr("is there 2 times"));
}

TEST(HardMatrix, ItsReportNamesWhatIsRedAndWhy) {
    const std::vector<Result> results{a_result("stall", true), a_result("jitter", false)};
    const std::string report = report_of(results, "a renderer", "a machine", {"folder/heat_map.png"});
    EXPECT_THAT(report, HasSubstr("| 2 | jitter | 8^3 | least | step 3: a \"bad\", long reason |"));
    EXPECT_THAT(report, HasSubstr("1 of 2 cells of single cases"));
    EXPECT_THAT(report, HasSubstr("](heat_map.png)"));
    EXPECT_THAT(table_line(results[1]), HasSubstr("RED"));
    EXPECT_THAT(heat_map_of(results, "folder").commands, HasSubstr("'jitter' 1"));
}

}  // namespace
}  // namespace eddy::stability
