#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

/// A lid stirs smoke around a ball in a thick fluid.
const std::string kStirred =
    "title = \"Stirred\"\n[tank]\ncells = [16, 16, 16]\n"
    "[tank.walls]\ny_high = { kind = \"no_slip\", velocity_m_s = [0.1, 0, 0] }\n"
    "[fluid]\nviscosity_pa_s = 0.001\n[smoke]\ninitial = \"y\"\n"
    "[[body]]\nname = \"ball\"\nradius_m = 0.03\ncentre_m = [0.08, 0.08, 0.08]\ntorque = false\n";

/// The numbers of the line "total" of a plan: passes, texels, bytes, fetches.
std::vector<std::string> totals_of(std::vector<std::string> scene) {
    scene.insert(scene.begin(), "simulate");
    scene.emplace_back("--plan");
    const Ended plan = eddy(scene);
    EXPECT_EQ(plan.status, 0) << plan.err;
    for (const std::string& line : lines_of(plan.out)) {
        std::istringstream words(line);
        std::vector<std::string> numbers(5);
        for (std::string& number : numbers) words >> number;
        if (numbers[0] == "total") return {numbers.begin() + 1, numbers.end()};
    }
    ADD_FAILURE() << "no total in\n" << plan.out;
    return {};
}

TEST(BenchEffects, AsCsvHasEachEffectOfTheSceneWithThePlansOfBothScenes) {
    const ScratchFolder folder;
    const std::string scene = folder.write("stirred.toml", kStirred);
    const Ended ended = eddy({"bench", "--effects", scene, "--repeats", "1", "--csv"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::vector<std::string> lines = lines_of(ended.out), header = split(lines.at(0), ',');
    std::map<std::string, std::map<std::string, std::string>> rows;  // by effect and what it is added to
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::vector<std::string> fields = split(lines[i], ',');
        ASSERT_EQ(fields.size(), header.size());
        for (std::size_t f = 0; f < fields.size(); ++f)
            rows[fields[0] + " " + fields[1]][header[f]] = fields[f];
    }
    for (const std::string effect : {"bodies", "force", "viscosity", "no-slip walls", "smoke"})
        for (const std::string added_to : {" whole", " bare"})
            EXPECT_TRUE(rows.contains(effect + added_to)) << effect << added_to;
    EXPECT_EQ(rows.size(), 2u * 5u + 1u) << ended.out;

    const auto expect_plan = [&](const std::string& row, const std::string& side,
                                 const std::vector<std::string>& plan) {
        EXPECT_EQ(rows[row]["passes_" + side], plan.at(0)) << row;
        EXPECT_EQ(rows[row]["texels_" + side], plan.at(1)) << row;
        EXPECT_EQ(rows[row]["bytes_written_" + side], plan.at(2)) << row;
        EXPECT_EQ(rows[row]["fetches_" + side], plan.at(3)) << row;
    };
    expect_plan("smoke whole", "with", totals_of({scene}));
    expect_plan("force whole", "without", totals_of({scene, "--set", "body.ball.force=false"}));
    const std::string bare =
        "[tank]\ncells = [16, 16, 16]\n[[body]]\nradius_m = 0.03\ncentre_m = [0.08, 0.08, 0.08]\n"
        "force = false\ntorque = false\n";
    expect_plan("all but the bodies whole", "without", totals_of({folder.write("bare.toml", bare)}));
    expect_plan("smoke bare", "with", totals_of({folder.write("smoke.toml", bare + "[smoke]\n")}));
    const auto& all = rows["all but the bodies whole"];
    EXPECT_LT(std::stol(all.at("texture_bytes_without")), std::stol(all.at("texture_bytes_with")));
}

TEST(BenchEffects, NamesTheRendererAndEachEffectInItsTableItsFileAndItsPlot) {
    const ScratchFolder folder;
    const std::string scene =
        folder.write("smoke.toml",
                     "title = \"Smoke's own\"\n[tank]\ncells = [16, 16, 16]\n[smoke]\ndissipation_1_s = 1\n");
    const Ended ended = eddy({"bench", "--effects", scene, "--repeats", "2", "--json",
                              folder / "effects.json", "--plot", folder / "effects.png"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const nlohmann::json j = nlohmann::json::parse(read_all(folder / "effects.json"));
    const std::string renderer = j.at("renderer");
    EXPECT_EQ(ended.out.rfind(renderer, 0), 0u) << ended.out;
    for (const std::string name : {"whole scene", "without smoke fading", "empty tank", "smoke"})
        EXPECT_NE(ended.out.find("\n" + name + " "), std::string::npos) << name << " in\n" << ended.out;
    EXPECT_EQ(j.at("variants").size(), 3u);  // without fading is smoke alone, without smoke the empty tank
    EXPECT_EQ(j.at("effects").size(), 2u);
    EXPECT_EQ(j.at("variants").at(0).at("times").at("wall").at("repeats"), 2);
    EXPECT_EQ(read_all(folder / "effects.png").substr(1, 3), "PNG");
    const std::string script = read_all(folder / "effects.gnuplot");
    EXPECT_NE(script.find("smoke fading"), std::string::npos);
    EXPECT_NE(script.find(renderer), std::string::npos);
}

}  // namespace
}  // namespace eddy
