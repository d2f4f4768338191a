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

TEST(HardCase, AfterItEndsNothingDrivesTheFluid) {
    Scene scene = common_scene({glm::ivec3(8), Effort::Least});
    scene.sources.resize(2);
    scene.sources[1].stop_s = 1.0;
    scene.tank.walls.x_low = {WallKind::Inflow, {{Formula(0.25), Formula::parse("x + t"), 0.0}}};
    falls_silent(scene, 2.0);
    EXPECT_LT(scene.sources[0].stop_s, 2.0);
    EXPECT_GT(scene.sources[0].stop_s, 2.0 - scene.solver.dt_s);
    EXPECT_EQ(scene.sources[1].stop_s, 1.0);
    const FormulaVector& u = *scene.tank.walls.x_low.velocity_m_s;
    EXPECT_EQ(u.evaluate({0.5, 0.0, 0.0}, 1.9), glm::dvec3(0.25, 2.4, 0.0));
    EXPECT_EQ(u.evaluate({0.5, 0.0, 0.0}, 2.0), glm::dvec3(0.25, 2.5, 0.0)) << "the step that ends then";
    EXPECT_EQ(u.evaluate({0.5, 0.0, 0.0}, 2.0 + scene.solver.dt_s), glm::dvec3(0.0));
    EXPECT_EQ(u.z.constant(), 0.0);
}

TEST(HardCase, AfterItEndsBodiesSlowDownWithoutAJerk) {
    constexpr double kDt = 1e-3;
    EXPECT_EQ(running_down_s(1.5, 2.0), 1.5);
    double pace = 1.0;
    for (double t = 2.0; t < 3.0; t += kDt) {
        const double slower = (running_down_s(t + kDt, 2.0) - running_down_s(t, 2.0)) / kDt;
        EXPECT_NEAR(slower, pace, 1.01 * kDt / kRunDownS) << t;
        EXPECT_LE(slower, pace + 1e-9) << t;
        pace = slower;
    }
    EXPECT_EQ(running_down_s(3.0, 2.0), running_down_s(2.0 + kRunDownS, 2.0));
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
