#include "firmware/accuracy/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace eddy::accuracy {
namespace {

using testing::HasSubstr;
using testing::Not;

const Case kCase{.name = "X1",
                 .title = "a drop",
                 .scene = "validation/X1",
                 .set = {"solver.cycles=3"},
                 .quantities = {{.name = "pull",
                                 .exact = 2.0,
                                 .source = "a book",
                                 .error = Quantity::Error::Relative,
                                 .limits = {{8, 0.1}}}}};

Study drop(std::initializer_list<double> pulls) {
    Study study{&kCase, {}};
    int cells = 4;
    for (const double pull : pulls) {
        study.rows.push_back({.cells = glm::ivec3(cells),
                              .cell_m = 1.0 / cells,
                              .dt_s = 0.5,
                              .steps = 7,
                              .step_ms = 1.5,
                              .total_s = 2.0,
                              .readings = {{.measured = pull}}});
        cells *= 2;
    }
    judge(kCase, study.rows);
    return study;
}

TEST(Report, TableHoldsCommandSourceErrorOrderAndVerdict) {
    const std::string table = table_of(drop({2.4, 2.1}));
    EXPECT_THAT(table, HasSubstr("X1  a drop\n"));
    EXPECT_THAT(table, HasSubstr("eddy simulate validation/X1 --set 'solver.cycles=3'\n"));
    EXPECT_THAT(table, HasSubstr("pull: a book\n"));
    EXPECT_THAT(table, testing::ContainsRegex("4x4x4 .* 2.4 .* 20 %\n"));
    EXPECT_THAT(table, testing::ContainsRegex("8x8x8 .* 2.1 .* 5 %   2.00  ok .*<= 10 %\n"));
    EXPECT_THAT(table, Not(HasSubstr("Richardson")));
}

TEST(Report, ThreeGridsAreExtrapolated) {
    EXPECT_THAT(table_of(drop({2.4, 2.1, 2.025})), HasSubstr("pull: 2 at h = 0 (Richardson, order 2.00)"));
}

TEST(Report, SummaryCountsTheLimitsThatWereMet) {
    const Study studies[] = {drop({2.4, 2.1}), drop({2.4, 2.3})};
    const std::string summary = summary_of(studies);
    EXPECT_THAT(summary, HasSubstr("1 of 2 limits met, in 8 s\n"));
    EXPECT_THAT(summary, HasSubstr("MISSED"));
    EXPECT_FALSE(missed(studies[0]));
    EXPECT_TRUE(missed(studies[1]));
}

TEST(Report, SummaryCountsTheEstimatesThatCoverTheError) {
    Case guessed = kCase;
    guessed.quantities.push_back({.name = "guess", .source = "a hunch", .estimates_error = true});
    Study study = drop({2.4, 2.1});  // 20 % and 5 % off
    study.of = &guessed;
    for (Row& row : study.rows) row.readings.push_back({.measured = 0.1});
    judge(guessed, study.rows);
    EXPECT_THAT(table_of(study), testing::ContainsRegex("guess .* 0.1 .* short\n(.*\n)*.*guess .* covers\n"));
    EXPECT_THAT(summary_of(std::span(&study, 1)),
                HasSubstr("1 of 2 estimates cover the error they are of\n"));
    EXPECT_THAT(csv_of(study), HasSubstr(",covers\n"));
    const nlohmann::json j = nlohmann::json::parse(json_of(std::span(&study, 1), {}));
    EXPECT_EQ(j.at("cases").at(0).at("grids").at(1).at("quantities").at(1).at("covers_error"), true);
    EXPECT_THAT(summary_of(std::vector{drop({2.4})}), Not(HasSubstr("estimates")));
}

TEST(Report, CsvHasAFieldForEachColumn) {
    const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
    const std::string line = csv_of(drop({2.4}));
    EXPECT_EQ(commas(line), commas(csv_header()));
    EXPECT_EQ(line, "X1,4,4,4,0.5,7,1.5,2,\"pull\",2.4,2,0.2,,,,\n");
}

TEST(Report, JsonHoldsWhatTheTableDoes) {
    const Study studies[] = {drop({2.4, 2.1})};
    gles::Capabilities driver;
    driver.renderer = "a card";
    const nlohmann::json j = nlohmann::json::parse(json_of(studies, driver));
    EXPECT_EQ(j.at("renderer"), "a card");
    const nlohmann::json& fine = j.at("cases").at(0).at("grids").at(1);
    EXPECT_EQ(fine.at("cells"), nlohmann::json({8, 8, 8}));
    const nlohmann::json& pull = fine.at("quantities").at(0);
    EXPECT_NEAR(pull.at("error"), 0.05, 1e-12);
    EXPECT_NEAR(pull.at("order"), 2.0, 1e-9);
    EXPECT_EQ(pull.at("met"), true);
    EXPECT_FALSE(j.at("cases").at(0).at("grids").at(0).at("quantities").at(0).contains("met"));
}

}  // namespace
}  // namespace eddy::accuracy
