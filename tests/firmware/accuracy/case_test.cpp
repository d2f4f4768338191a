#include "firmware/accuracy/case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "firmware/accuracy/study.h"
#include "firmware/input_error.h"

namespace eddy::accuracy {
namespace {

TEST(Cases, HaveNamesOfTheirOwnAndSayWhatIsExactAndWhoSaysSo) {
    std::set<std::string> names;
    for (const Case& one : all_cases()) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
        EXPECT_FALSE(one.title.empty()) << one.name;
        EXPECT_TRUE(one.measure) << one.name;
        ASSERT_FALSE(one.quantities.empty()) << one.name;
        for (const Quantity& quantity : one.quantities) {
            EXPECT_FALSE(quantity.name.empty()) << one.name;
            EXPECT_FALSE(quantity.source.empty()) << one.name << ": " << quantity.name;
            EXPECT_TRUE(!quantity.estimates_error || &quantity != &one.quantities.front()) << one.name;
            EXPECT_TRUE(quantity.error == Quantity::Error::Absolute || quantity.exact != 0.0) << one.name;
        }
    }
}

TEST(Cases, FitTheirTanksOnEveryGridOfTheirs) {
    for (const Case& one : all_cases()) {
        EXPECT_FALSE(one.full.empty()) << one.name;
        for (const std::vector<int>& grids : {one.quick, one.full}) {
            EXPECT_TRUE(std::is_sorted(grids.begin(), grids.end())) << one.name;
            for (const int cells : grids)
                EXPECT_NO_THROW(scene_on_grid(one, cells)) << one.name << " " << cells;
        }
    }
}

TEST(Cases, UseEveryValidationScene) {
    std::set<std::string> used;
    for (const Case& one : all_cases()) used.insert(one.scene);
    const auto shipped = validation_scenes();
    EXPECT_EQ(used, std::set<std::string>(shipped.begin(), shipped.end()));
}

TEST(Cases, AreFoundByNameAndByFamily) {
    ASSERT_EQ(cases_named("B2-shell").size(), 1u);
    EXPECT_EQ(cases_named("B2-shell").front()->name, "B2-shell");
    EXPECT_EQ(cases_named("B2").size(), 2u);
    EXPECT_EQ(cases_named("A2").size(), 1u);
    EXPECT_EQ(cases_named("B8.13").size(), 2u);
    EXPECT_EQ(cases_named("B8.1").size(), 1u);
    EXPECT_GT(cases_named("B8").size(), 10u);
}

TEST(Cases, ThatDoNotExistAreAnsweredWithTheNearest) {
    try {
        cases_named("A111");
        FAIL();
    } catch (const InputError& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr("there is no such case; nearest first: \"A11\""));
    }
}

}  // namespace
}  // namespace eddy::accuracy
