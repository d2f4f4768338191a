#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;

TEST(Accuracy, ListsItsCasesWithTheirGrids) {
    const Ended ended = eddy({"accuracy", "--list"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, testing::ContainsRegex("B2-shell +26 +26,39,52 +added mass"));
}

TEST(Accuracy, ShowsErrorOrderAndCostAndKeepsThemInAFile) {
    const ScratchFolder folder;
    const std::string json = folder / "accuracy.json";
    const Ended ended =
        eddy({"accuracy", "--validate", "--case", "B2-box", "--grid", "20,30", "--json", json});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("eddy simulate validation/B2-box"));
    EXPECT_THAT(ended.out, HasSubstr("20x20x20"));
    EXPECT_THAT(ended.out, HasSubstr("2 of 2 limits met"));
    const nlohmann::json j = nlohmann::json::parse(read_all(json));
    EXPECT_THAT(ended.out, HasSubstr(j.at("renderer").get<std::string>()));
    const nlohmann::json& fine = j.at("cases").at(0).at("grids").at(1);
    EXPECT_EQ(fine.at("steps"), 8);
    EXPECT_GT(fine.at("step_ms_p50"), 0.0);
    EXPECT_GT(fine.at("quantities").at(0).at("order"), 1.0);
}

TEST(Accuracy, FailsWhereALimitIsMissed) {
    // Semi-Lagrangian transport smooths the more, the shorter the steps: it does not gain from them.
    const Ended ended = eddy({"accuracy", "--validate", "--case", "A1-refined", "--grid", "16,32", "--set",
                              "solver.advection=\"semi_lagrangian\"", "--csv"});
    EXPECT_EQ(ended.status, 1) << ended.err;
    const std::vector<std::string> lines = lines_of(ended.out);
    ASSERT_EQ(lines.size(), 5u) << ended.out;
    EXPECT_EQ(split(lines[0], ',').back(), "verdict");
    EXPECT_EQ(split(lines[3], ',').back(), "MISSED") << lines[3];
}

TEST(Accuracy, CaseCanBeRunAsAScene) {
    EXPECT_EQ(eddy({"simulate", "validation/B2-box", "--set", kTiny, "--steps", "1"}).status, 0);
}

TEST(Accuracy, SaysWhatIsWrongBeforeItRunsAnything) {
    const std::pair<std::vector<std::string>, const char*> wrong[] = {
        {{"accuracy"}, "--validate"},
        {{"accuracy", "--validate", "--case", "B22"}, "there is no such case; nearest first: "},
        {{"accuracy", "--validate", "--case", "B1-shapes", "--grid", "81"}, "--grid 81: "},
        {{"accuracy", "--validate", "--case", "B3", "--set", "solver.cycle=3"}, "solver.cycle"},
        {{"accuracy", "--validate", "--full", "--grid", "16"}, "--grid"},
        {{"accuracy", "--validate", "--case", "B3", "--json", "/nowhere/a.json"}, "/nowhere"}};
    for (const auto& [arguments, word] : wrong) {
        const Ended ended = eddy(arguments);
        EXPECT_EQ(ended.status, 2) << word;
        EXPECT_THAT(ended.err, HasSubstr(word));
        EXPECT_EQ(ended.out, "");
    }
}

}  // namespace
}  // namespace eddy
