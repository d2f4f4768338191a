#include "firmware/stability/case.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/firmware/stability/complaint.h"

namespace eddy::stability {
namespace {

using testing::HasSubstr;

TEST(HardCase, EveryNumberOfTheListIsTriedOrSaidToBeMissing) {
    std::set<int> numbers;
    for (const Case& one : all_cases()) numbers.insert(one.number);
    for (const NotTried& one : not_offered()) numbers.insert(one.number);
    for (const NotTried& one : tried_elsewhere()) numbers.insert(one.number);
    for (int number = 1; number <= 34; ++number) EXPECT_TRUE(numbers.contains(number)) << number;
}

TEST(HardCase, HasANameOfItsOwnAndSaysWhatItIsAbout) {
    std::set<std::string> names;
    for (const Case& one : all_cases()) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
        EXPECT_FALSE(one.title.empty()) << one.name;
        EXPECT_FALSE(one.provokes.empty()) << one.name;
        EXPECT_EQ(one.wants.empty(), !one.complaint && !one.watches_transport)
            << one.name << ": what it wants must be judged, and said";
        EXPECT_EQ(one.name.find_first_of(",+\" "), std::string::npos) << one.name;
    }
}

TEST(HardCase, IsFoundByNumberAndByName) {
    EXPECT_EQ(cases_named("piston").size(), 1u);
    EXPECT_EQ(cases_named("4").size(), 3u);
    EXPECT_THAT(complaint_about([] { cases_named("pistol"); }), HasSubstr("nearest first: \"piston\""));
    EXPECT_THAT(complaint_about([] { cases_named("31"); }), HasSubstr("no free surface"));
    EXPECT_THAT(complaint_about([] { cases_named("21"); }), HasSubstr("eddy stability --endless 100000"));
}

TEST(HardCase, GridsAreNamedAsTheyAreWritten) {
    EXPECT_EQ(grid_named("25"), glm::ivec3(25));
    EXPECT_EQ(grid_named("25^3"), glm::ivec3(25));
    EXPECT_EQ(grid_named("33x47x29"), glm::ivec3(33, 47, 29));
    EXPECT_EQ(grid_name({33, 47, 29}), "33x47x29");
    EXPECT_EQ(grid_name(glm::ivec3(25)), "25^3");
    for (const char* wrong : {"", "x", "8x8", "25^2", "3", "8x8x1000", "8x8x8x8"})
        EXPECT_THAT(complaint_about([&] { grid_named(wrong); }), HasSubstr("write a grid as")) << wrong;
}

TEST(HardCase, ChangesTheCommonSceneAlsoWhenOthersHave) {
    for (const Case& first : all_cases())
        for (const Case& second : all_cases()) {
            Scene scene = common_scene({glm::ivec3(8), Effort::Least});
            if (first.change) first.change(scene);
            if (second.change) second.change(scene);
            EXPECT_EQ(scene.tank.cells, glm::ivec3(8));
        }
}

}  // namespace
}  // namespace eddy::stability
