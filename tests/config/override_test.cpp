#include "config/override.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/scene.h"
#include "tests/config/complaints.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kTwoBodies =
    "[[body]]\nname = \"ball\"\nradius_m = 0.01\ncentre_m = [0.05, 0.05, 0.05]\n"
    "[[body]]\nradius_m = 0.01\ncentre_m = [0.1, 0.1, 0.1]\n";

Scene with(const std::vector<std::string>& overrides) {
    return read_scene(kTwoBodies, "s.toml", overrides).scene;
}

std::vector<std::string> complaints_about(const std::vector<std::string>& overrides) {
    return complaints([&] { with(overrides); });
}

TEST(Override, WinsOverTheFileAndOverTheDefault) {
    EXPECT_EQ(with({"solver.dt_s=0.01"}).solver.dt_s, 0.01);
    EXPECT_EQ(with({"body.0.radius_m=0.02"}).bodies[0].radius_m, 0.02);
    EXPECT_EQ(with({"tank.cells=[32, 32, 32]"}).tank.cells, glm::ivec3(32));
    EXPECT_EQ(with({"title=\"a = b\""}).title, "a = b");
}

TEST(Override, LaterOneWins) {
    EXPECT_EQ(with({"solver.dt_s=0.01", "solver.dt_s=0.03"}).solver.dt_s, 0.03);
}

TEST(Override, FindsABodyByNumberByNameAndByTheNameItWillGet) {
    EXPECT_EQ(with({"body.1.radius_m=0.02"}).bodies[1].radius_m, 0.02);
    EXPECT_EQ(with({"body.ball.radius_m=0.02"}).bodies[0].radius_m, 0.02);
    EXPECT_EQ(with({"body.body2.radius_m=0.02"}).bodies[1].radius_m, 0.02);
}

TEST(Override, ReachesIntoVectorsAndMakesTables) {
    EXPECT_EQ(with({"body.0.centre_m.2=0.06"}).bodies[0].centre_m, glm::dvec3(0.05, 0.05, 0.06));
    EXPECT_EQ(with({"smoke.dissipation_1_s=0.5"}).smoke.value().dissipation_1_s, 0.5);
    EXPECT_TRUE(with({"smoke={}"}).smoke);
}

TEST(Override, MistakesPointIntoTheOverride) {
    EXPECT_THAT(complaints_about({"title=\"x\"", "solver.dt_s=9"}),
                ElementsAre("--set:2:13: solver.dt_s: 9 is out of range: must be above 0 and at most 1"));
    EXPECT_THAT(complaints_about({"solver.dt=1"}),
                ElementsAre("--set:1:8: solver.dt: unknown key; nearest valid key: dt_s"));
    EXPECT_THAT(complaints_about({"slover.dt_s=1"}),
                ElementsAre("--set:1:1: slover: unknown key; nearest valid key: solver"));
    EXPECT_THAT(complaints_about({"body.bal.radius_m=1"}),
                ElementsAre(StartsWith("--set:1:6: body.bal.radius_m: no element \"bal\"")));
    EXPECT_THAT(complaints_about({"body.2.radius_m=1"}),
                ElementsAre(StartsWith("--set:1:6: body.2.radius_m: no element \"2\" in a list of 2")));
    EXPECT_THAT(complaints_about({"body.0.radius_m.deep=1"}),
                ElementsAre(StartsWith("--set:1:17: body.0.radius_m.deep: ")));
}

TEST(Override, ThatIsNoAssignmentIsRefused) {
    for (const std::string text : {"", "=", "=3", "solver", "solver..dt_s=1", ".=1", "solver.=1"})
        EXPECT_THAT(complaints_about({text}),
                    ElementsAre(HasSubstr("expected key=value, as in solver.dt_s=0.01")))
            << text;
    EXPECT_THAT(complaints_about({"solver.dt_s="}), ElementsAre(StartsWith("--set:1:")));
    EXPECT_THAT(complaints_about({"solver.dt_s=1\ntitle=2"}), ElementsAre(HasSubstr("more than one value")));
}

TEST(Override, ForgottenQuotesAreSuggested) {
    EXPECT_THAT(complaints_about({"solver.preset=precise"}),
                ElementsAre(HasSubstr("text needs quotes: solver.preset=\"precise\"")));
}

TEST(Override, AllMistakesComeWithThoseOfTheFile) {
    const auto lines = complaints([] {
        read_scene("titel = 1\n", "s.toml",
                   std::vector<std::string>{"solver.dt_s=9", "nonsense", "fluid.density_kg_m3=-1"});
    });
    EXPECT_EQ(lines.size(), 4u);
}

}  // namespace
}  // namespace eddy
