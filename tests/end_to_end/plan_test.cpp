#include <gtest/gtest.h>

#include <array>
#include <regex>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

/// The table that `eddy simulate --plan` prints.
struct PrintedPlan {
    std::string text;
    std::array<long, 4> sums{}, total{};  // times, texels, bytes, fetches

    bool names(const std::string& word) const { return std::regex_search(text, std::regex("\\b" + word)); }
};

PrintedPlan plan_of(std::vector<std::string> scene) {
    scene.insert(scene.begin(), "simulate");
    scene.emplace_back("--plan");
    const Ended ended = eddy(scene);
    EXPECT_EQ(ended.status, 0) << ended.err;
    PrintedPlan plan{ended.out, {}, {}};
    const std::regex row(R"(^(.{16}) (.{22,}?) +(\d+) +(\d+) +(\d+) +(\d+))");
    for (const std::string& line : lines_of(ended.out)) {
        std::smatch m;
        if (!std::regex_search(line, m, row)) continue;
        auto& into = line.rfind("total", 0) == 0 ? plan.total : plan.sums;
        for (std::size_t i = 0; i < 4; ++i) into[i] += std::stol(m[3 + i]);
    }
    return plan;
}

TEST(Plan, AddsUpToItsTotal) {
    for (const std::string scene : {"jet", "stir", "rest", "bench"})
        for (const std::string preset : {"fast", "precise", "yang2009"}) {
            if (preset != "yang2009" && scene != "jet" && scene != "rest") continue;
            const PrintedPlan plan =
                plan_of({scene, "--set", kTiny, "--set", "solver.preset=\"" + preset + "\""});
            EXPECT_GT(plan.total[0], 10) << plan.text;
            EXPECT_EQ(plan.sums, plan.total) << scene << " " << preset << "\n" << plan.text;
        }
}

TEST(Plan, WithoutSmokeHasNoSmokePassAndNoScalarTexture) {
    const PrintedPlan rest = plan_of({"rest", "--set", kTiny}), jet = plan_of({"jet", "--set", kTiny});
    EXPECT_TRUE(jet.names("advect smoke") && jet.names("R32F")) << jet.text;
    EXPECT_FALSE(rest.names("smoke")) << rest.text;
    EXPECT_FALSE(rest.names("R32F")) << rest.text;
}

TEST(Plan, HasOnlyTheHeatThatTheSceneHas) {
    const ScratchFolder folder;
    const std::string still = "[tank]\ncells = [16, 16, 16]\n[fluid]\ngravity_m_s2 = [0, -9.81, 0]\n";
    const auto plan = [&](const std::string& heat) {
        return plan_of({folder.write("scene.toml", still + heat)});
    };
    const PrintedPlan none = plan(""), carried = plan("[temperature]\n"),
                      all = plan("[temperature]\nexpansion_1_k = 0.003\ndiffusivity_m2_s = 1e-3\n");
    EXPECT_TRUE(all.names("advect heat") && all.names("diffusion smooth") &&
                all.names("velocity temperature"))
        << all.text;
    EXPECT_TRUE(carried.names("advect heat") && carried.names("R32F")) << carried.text;
    // It pushes nothing; but whether it is sound is looked at.
    EXPECT_FALSE(carried.names("diffusion") || carried.names("velocity temperature")) << carried.text;
    EXPECT_FALSE(none.names("heat") || none.names("R32F") || none.names("temperature")) << none.text;
}

TEST(Plan, OfAnImposedFlowIsTransportAndHealthAlone) {
    const ScratchFolder folder;
    const auto plan = [&](const std::string& u) {
        return plan_of({folder.write(
            "scene.toml", "[tank]\ncells = [16, 16, 16]\n[smoke]\n[imposed]\nvelocity_m_s = " + u)});
    };
    const PrintedPlan steady = plan("[\"-y\", \"x\", 0]\n"), waving = plan("[\"cos(t)\", 0, 0]\n");
    EXPECT_EQ(steady.total[0], 1 + 3) << steady.text;  // drawn once, before
    EXPECT_TRUE(steady.names("advect smoke")) << steady.text;
    EXPECT_EQ(waving.total[0], 2 + 3) << waving.text;
    EXPECT_TRUE(waving.names("imposed flow")) << waving.text;
}

TEST(Plan, WithoutABodyHasNoFractionsAndNoForce) {
    const ScratchFolder folder;
    const std::string scene = folder.write("empty.toml", "[tank]\ncells = [16, 16, 16]\n");
    const PrintedPlan empty = plan_of({scene}), rest = plan_of({"rest", "--set", kTiny});
    for (const std::string word : {"fractions", "traction", "voxelise", "force", "ax"}) {
        EXPECT_TRUE(rest.names(word)) << word << " is not how the plan calls it:\n" << rest.text;
        EXPECT_FALSE(empty.names(word)) << word << "\n" << empty.text;
    }
}

TEST(Plan, OfABodyThatIsNotMeasuredHasNoForce) {
    const PrintedPlan plan = plan_of(
        {"rest", "--set", kTiny, "--set", "body.ball.force=false", "--set", "body.ball.torque=false"});
    EXPECT_TRUE(plan.names("fractions")) << plan.text;
    EXPECT_FALSE(plan.names("traction")) << plan.text;
}

TEST(Plan, OfABodyWhoseTorqueIsNotMeasuredHasNoTorqueAndTheSameForForce) {
    const std::pair<std::string, long> kPresets[] = {{"fast", 2}, {"precise", 2}, {"yang2009", 4}};
    for (const auto& [preset, sum] : kPresets) {  // passes that add up one of the two
        const auto plan = [&](const std::string& change) {
            return plan_of({"rest", "--set", kTiny, "--set", "solver.preset=\"" + preset + "\"", "--set",
                            "body.ball." + change});
        };
        const PrintedPlan both = plan("force=true"), force = plan("torque=false"),
                          torque = plan("force=false");
        EXPECT_EQ(both.total[0] - force.total[0], sum) << force.text;
        EXPECT_EQ(both.total[0] - torque.total[0], sum) << torque.text;
        EXPECT_EQ(force.total[2], torque.total[2]);
        EXPECT_LT(force.total[2], both.total[2]);
        EXPECT_TRUE(both.names("pivot") && torque.names("pivot")) << torque.text;
        EXPECT_FALSE(force.names("pivot")) << force.text;
    }
}

}  // namespace
}  // namespace eddy
