#include "firmware/accuracy/sweep/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/accuracy/sweep/report.h"
#include "firmware/input_error.h"

namespace eddy::accuracy::sweep {
namespace {

using testing::HasSubstr;

Measurement measured(std::size_t index, const Setting& setting, double error, double wall_ms) {
    return {.index = index,
            .point = {"B2", setting},
            .error = error,
            .dt_s = 0.005,
            .repeats = 30,
            .wall_ms = {wall_ms, 1.5 * wall_ms},
            .cpu_ms = {2.0 * wall_ms, 2.5 * wall_ms}};
}

Table small_sweep() {
    Table table{"1.2.3", "a card", {"a machine"}, {.cases = {"B2"}, .grids = {64}}, 3};
    table.measured = {measured(0, {SolverPreset::Fast, 64, 2}, 0.01, 80.0),
                      measured(1, {SolverPreset::Yang2009, 64, 40, 0.5, ForceWay::Impulse}, 0.5, 400.0),
                      measured(2, {SolverPreset::Yang2009, 64, 160}, 0.2, 1600.0)};
    table.measured[0].gpu_ms = Spread{70.0, 75.0};
    table.measured[0].stages = {{"pressure", 60.0}, {"advect velocity", 9.5}};
    return table;
}

/// Every second point of it, from the first or from the second on.
Table part(std::size_t first) {
    Table table = small_sweep();
    std::erase_if(table.measured, [&](const Measurement& m) { return m.index % 2 != first; });
    return table;
}

std::string complaint(const std::vector<Table>& shards) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < shards.size(); ++i) names.push_back("folder" + std::to_string(i + 1));
    try {
        merged(shards, names);
    } catch (const InputError& e) {
        return e.what();
    }
    return "none";
}

TEST(SweepTable, JsonReadsBackToTheSameTable) {
    EXPECT_EQ(table_from_json(json_of(small_sweep()), "a file"), small_sweep());
}

TEST(SweepTable, ErrorThatIsNoNumberStaysNone) {
    Table table = small_sweep();
    table.measured[1].error = std::nan("");
    EXPECT_TRUE(std::isnan(table_from_json(json_of(table), "a file").measured[1].error));
    EXPECT_THAT(report_of(table), HasSubstr("yang2009"));
}

TEST(SweepTable, ForeignJsonIsNamed) {
    for (const char* foreign : {"", "{}", "{\"points\": 3", "[1, 2]"}) {
        try {
            table_from_json(foreign, "there/accuracy.json");
            FAIL() << foreign;
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), HasSubstr("there/accuracy.json: is not what")) << foreign;
        }
    }
    Table beyond = small_sweep();
    beyond.points = 2;
    EXPECT_THROW(table_from_json(json_of(beyond), "a file"), InputError);
}

TEST(SweepTable, CsvHasAFieldForEachColumn) {
    const std::string csv = csv_of(small_sweep());
    std::vector<std::ptrdiff_t> commas(1);
    for (const char c : csv) {
        if (c == ',') ++commas.back();
        if (c == '\n') commas.push_back(0);
    }
    commas.pop_back();
    EXPECT_THAT(commas, testing::ElementsAre(15, 15, 15, 15)) << csv;
    EXPECT_THAT(csv, HasSubstr("B2,fast,64,2,1,surface,0.005,0.01,0.1429,30,80,120,160,200,70,75\n"));
    EXPECT_THAT(csv, HasSubstr("B2,yang2009,64,40,0.5,impulse,"));
}

TEST(SweepTable, PartsMakeTheWhole) {
    Table whole = small_sweep();
    const std::vector<Table> shards{part(1), part(0)};
    const std::vector<std::string> names{"second", "first"};
    EXPECT_EQ(merged(shards, names), whole);
}

TEST(SweepTable, MergedTellsTheMachinesApart) {
    std::vector<Table> shards{part(0), part(1)};
    const std::vector<std::string> names{"first", "second"};
    EXPECT_THAT(report_of(merged(shards, names)), testing::Not(HasSubstr("compare errors, not times")));
    shards[1].machines = {"another"};
    EXPECT_THAT(merged(shards, names).machines, testing::ElementsAre("a machine", "another"));
    EXPECT_THAT(report_of(merged(shards, names)), HasSubstr("compare errors, not times"));
}

TEST(SweepTable, PartsOfDifferentSweepsAreRefused) {
    EXPECT_EQ(complaint({part(0), part(1)}), "none");
    Table other = part(1);
    other.version = "1.2.4";
    EXPECT_THAT(complaint({part(0), other}), HasSubstr("folder1 has version 1.2.3, folder2 has 1.2.4"));
    other = part(1);
    other.renderer = "another card";
    EXPECT_THAT(complaint({part(0), other}), HasSubstr("renderer"));
    other = part(1);
    other.order.full = true;
    EXPECT_THAT(complaint({part(0), other}), HasSubstr("different sweeps"));
    EXPECT_THAT(
        complaint({part(0), part(1), part(1)}),
        HasSubstr("folder2 and folder3 both hold B2 yang2009 64^3, 40 sweeps, 0.5 dt, force by impulse"));
    EXPECT_THAT(complaint({part(0)}),
                HasSubstr("1 of 3 points are in none of these, the first of them number 2"));
}

TEST(SweepReport, HeadlineSaysTheTimeToReachAnError) {
    const std::string report = report_of(small_sweep());
    EXPECT_THAT(report, HasSubstr("a card  \na machine\n"));
    EXPECT_THAT(report, HasSubstr("| within | 10 % | 7 % (hand) | 5 % | 2 % | 1 % | best |\n"));
    EXPECT_THAT(report,
                HasSubstr("| `fast` | 80 ms: 64³ ×2 | 80 ms: 64³ ×2 | 80 ms: 64³ ×2 | 80 ms: 64³ ×2 | "
                          "80 ms: 64³ ×2 | 1 % in 80 ms: 64³ ×2 |\n"));
    EXPECT_THAT(report, HasSubstr("| `yang2009` | – | – | – | – | – | 20 % in 1600 ms: 64³ ×160 |\n"));
    EXPECT_THAT(report, HasSubstr("a hand cannot tell (7 %): 80 ms a step, fast 64^3, 2 cycles.\n"));
    EXPECT_THAT(report, HasSubstr("At 20 Hz, a step within 50 ms: nothing that was tried."));
}

TEST(SweepReport, ThreeWaysStandBesideEachOtherAndNotInTheHeadline) {
    Table table = small_sweep();
    table.measured.erase(table.measured.begin() + 1);
    EXPECT_THAT(report_of(table), testing::Not(HasSubstr("three ways")));
    table.measured.push_back(measured(3, {SolverPreset::Fast, 64, 2, 1.0, ForceWay::Box}, 0.001, 1.0));
    EXPECT_THAT(report_of(table), HasSubstr("At 20 Hz, a step within 50 ms: nothing that was tried."));
    EXPECT_THAT(
        report_of(table),
        testing::AllOf(HasSubstr("in three ways\n"), HasSubstr("| fast 64^3, 2 cycles | 1 % | 80 ms |\n"),
                       HasSubstr("| fast 64^3, 2 cycles, force by box | 0.1 % | 1 ms |\n")));
}

TEST(SweepReport, YardstickIsTheBestOfThe2009MethodWithUpTo160Sweeps) {
    Table table = small_sweep();
    table.measured.push_back(measured(3, {SolverPreset::Yang2009, 64, 320}, 0.15, 3000.0));
    table.measured.push_back(measured(4, {SolverPreset::Fast, 96, 2}, 0.005, 300.0));
    table.measured.push_back(measured(5, {SolverPreset::Yang2009, 96, 40}, 0.1, 3000.0));
    const std::optional<Yardstick> y = yardstick(table);
    ASSERT_TRUE(y);
    EXPECT_EQ(y->fast, &table.measured[0]);
    EXPECT_EQ(y->yang2009, &table.measured[2]);
    EXPECT_THAT(report_of(table), HasSubstr("as exact in 0.05 of the time"));
    table.measured[0].error = 0.3;
    EXPECT_THAT(report_of(table), HasSubstr("`fast` does not get as exact"));
    table.measured.erase(table.measured.begin());
    EXPECT_EQ(yardstick(table)->fast->point.setting.cells, 96);
    table.measured.clear();
    EXPECT_FALSE(yardstick(table));
}

}  // namespace
}  // namespace eddy::accuracy::sweep
