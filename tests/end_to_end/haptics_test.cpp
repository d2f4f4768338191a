#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

TEST(Haptics, QuickStudyReachesItsGoalsAndWritesThemDown) {
    const ScratchFolder folder;
    const Ended ended = eddy({"haptics", "--quick", "--out", folder / "study"});
    EXPECT_EQ(ended.status, has_gnuplot() ? 0 : 1) << ended.err;
    EXPECT_NE(ended.out.find("yes roughness"), std::string::npos);
    EXPECT_NE(ended.out.find("yes from motion"), std::string::npos);
    const std::string csv = read_all(folder / "study/haptics.csv");
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "fluid,trial,law,rate_hz,of,value");
    EXPECT_NE(csv.find("known,circle,model,50,roughness,"), std::string::npos);
    EXPECT_NE(read_all(folder / "study/report.md").find("| yes |"), std::string::npos);
}

TEST(Haptics, ASceneWithNothingInTheHandIsBadInput) {
    const Ended ended = eddy({"haptics", "--scene", "bubble"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_NE(ended.err.find("--scene bubble"), std::string::npos) << ended.err;
}

TEST(Haptics, ARunSaysInItsStatusWhatTheModelKnowsAndHowMuchOfTheGainIsLeft) {
    const ScratchFolder folder;
    const Ended ended = eddy({"run", "--scene", "stir", "--set", "tank.cells=[16,16,16]", "--clock",
                              "stepped", "--seconds", "5", "--run-dir", folder / "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_NE(ended.err.find("the gain is held at"), std::string::npos) << ended.err;
    const nlohmann::json haptics = nlohmann::json::parse(read_all(folder / "run/status.json"))["haptics"];
    EXPECT_LT(haptics["gain"].get<double>(), haptics["gain_of_scene"].get<double>());
    EXPECT_GT(haptics["model_drag_ns_m"].get<double>() + haptics["model_added_kg"].get<double>(), 0.0);
}

}  // namespace
}  // namespace eddy
