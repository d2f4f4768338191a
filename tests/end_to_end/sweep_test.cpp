#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;

/// A sweep of few points on a grid so coarse that each takes a moment.
std::vector<std::string> small_sweep(const std::string& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"accuracy", "--sweep", "--case", "A1", "--grid", "8", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Sweep, PartsPutTogetherAreTheWhole) {
    const ScratchFolder folder;
    for (const std::string part : {"1", "2"}) {
        const Ended ended = eddy(small_sweep(folder / part, {"--shard", part + "/2"}));
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_THAT(ended.out, HasSubstr("part " + part + " of 2, 3 of 6 points"));
    }
    const Ended ended = eddy({"accuracy", "--merge", folder / "1", folder / "2", "--out", folder / "all"});
    EXPECT_EQ(ended.status, has_gnuplot() ? 0 : 1) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("fast 8^3, 2 cycles, 0.5 dt"));
    EXPECT_EQ(lines_of(read_all(folder / "all/accuracy.csv")).size(), 7u);
    const nlohmann::json j = nlohmann::json::parse(read_all(folder / "all/accuracy.json"));
    EXPECT_THAT(ended.out, HasSubstr(j.at("renderer").get<std::string>()));
    ASSERT_EQ(j.at("measured").size(), 6u);
    for (const nlohmann::json& one : j.at("measured")) {
        EXPECT_GT(one.at("wall_ms").at("p50"), 0.0);
        EXPECT_GE(one.at("repeats"), 30);
        EXPECT_GT(one.at("error"), 0.0);
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "all/viscosity.gnuplot"));

    const Ended half = eddy({"accuracy", "--merge", folder / "1", "--out", folder / "half"});
    EXPECT_EQ(half.status, 2);
    EXPECT_THAT(half.err, HasSubstr("3 of 6 points are in none of these"));
    EXPECT_FALSE(std::filesystem::exists(folder / "half"));
}

TEST(Sweep, ForceMoreExactOnAFinerGridAndItsPicturesAreDrawn) {
    if (!has_gnuplot()) GTEST_SKIP() << "skipped: gnuplot is not installed";
    const ScratchFolder folder;
    const Ended ended =
        eddy({"accuracy", "--sweep", "--case", "B2", "--grid", "12,20", "--out", folder / "out"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("Against the method of 2009, 20³ cells: `fast` is "));
    for (const char* picture : {"work_B2.png", "iterations.png", "stages.png"})
        EXPECT_GT(read_all(folder / (std::string("out/") + picture)).size(), 10000u) << picture;
    const nlohmann::json j = nlohmann::json::parse(read_all(folder / "out/accuracy.json"));
    const auto error = [&](const char* method, int cells, int iterations, const char* force) {
        for (const nlohmann::json& one : j.at("measured"))
            if (one.at("method") == method && one.at("cells") == cells &&
                one.at("iterations") == iterations && one.at("force") == force)
                return one.at("error").get<double>();
        ADD_FAILURE() << method << cells << iterations << force;
        return 0.0;
    };
    EXPECT_LT(error("fast", 20, 2, "surface"), 0.6 * error("fast", 12, 2, "surface"));
    EXPECT_LT(error("precise", 20, 6, "surface"), error("yang2009", 20, 160, "surface"));
    // Without friction the three ways differ by 1e-7 of the force.
    EXPECT_NEAR(error("fast", 20, 2, "box"), error("fast", 20, 2, "surface"), 1e-4);
    EXPECT_NEAR(error("fast", 20, 2, "impulse"), error("fast", 20, 2, "surface"), 1e-4);
}

TEST(Sweep, SaysWhatIsWrongBeforeItRunsAnything) {
    const ScratchFolder folder;
    const std::string file = folder.write("file", "");
    folder.write("accuracy.json", "{}");
    const std::pair<std::vector<std::string>, std::string> wrong[] = {
        {{"accuracy", "--sweep"}, "--out"},
        {small_sweep(folder / "out", {"--shard", "5/4"}), "--shard 5/4: parts count from 1 to 4"},
        {small_sweep(folder / "out", {"--shard", "half"}), "write which part of how many"},
        {small_sweep(folder / "out", {"--validate"}), "--validate"},
        {small_sweep(folder / "out", {"--case", "B22"}), "there is no such case in a sweep; nearest first: "},
        {small_sweep(file + "/out"), "--out"},
        {{"accuracy", "--merge", folder / "nothing", "--out", folder / "out"}, "there is no "},
        {{"accuracy", "--merge", folder.path().string(), "--out", folder / "out"},
         "is not what eddy accuracy"}};
    for (const auto& [arguments, word] : wrong) {
        const Ended ended = eddy(arguments);
        EXPECT_EQ(ended.status, 2) << word;
        EXPECT_THAT(ended.err, HasSubstr(word));
        EXPECT_EQ(ended.out, "");
    }
    EXPECT_THAT(folder.listing(), testing::ElementsAre("accuracy.json", "file"));
}

}  // namespace
}  // namespace eddy
