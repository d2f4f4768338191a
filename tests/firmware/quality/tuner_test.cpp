#include "firmware/quality/tuner.h"

#include <gmock/gmock.h>

#include "firmware/input_error.h"
#include "tests/firmware/quality/small_tank.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::Field;
using testing::MatchesRegex;

class TunerTest : public gles::GlTest {
  protected:
    /// Of a machine with this scene; `pieces` is how much work it was.
    Tuning tuning_of(const Scene& scene) {
        Tuner tuner(gpu, scene);
        while (!tuner.done()) {
            tuner.work();
            ++pieces;
        }
        return tuner.tuning();
    }

    int pieces = 0;
};

std::vector<Quality> tried(const Tuning& tuning) {
    std::vector<Quality> all;
    for (const Rung& rung : tuning.measured) all.push_back(rung.quality);
    return all;
}

TEST_F(TunerTest, TriesEachNumberOfIterationsAndKeepsPresetAndRate) {
    const Tuning tuning = tuning_of(small_tank("dt_s = 0.05\n"));
    const auto cycles = [](int n) { return Quality{SolverPreset::Fast, 13, n}; };
    EXPECT_THAT(tried(tuning), ElementsAre(cycles(1), cycles(2), cycles(3)));
    EXPECT_DOUBLE_EQ(tuning.target_hz, 20.0);
    for (const Rung& rung : tuning.measured) {
        EXPECT_GT(rung.step_ms, 0.0);
        EXPECT_GE(rung.step_ms_p95, rung.step_ms);
        EXPECT_GT(rung.force_error, 0.0);
        EXPECT_LT(rung.force_error, 1.0);
    }
    EXPECT_GT(tuning.picture_ms, 0.0);
    EXPECT_LT(tuning.budget_ms, 50.0);
    EXPECT_GE(tuning.budget_ms, 30.0) << "pictures may take 40 % of the time";
    EXPECT_LT(tuning.chosen, tuning.ladder.size());
    EXPECT_GE(pieces, 3 * 60) << "each timed step is a piece";
    EXPECT_THAT(tuning.made_at, MatchesRegex("20..-..-..T..:..:..Z"));
    EXPECT_EQ(tuning.scene, print_scene(small_tank("dt_s = 0.05\n")));
}

TEST_F(TunerTest, OfTheMethodOf2009TriesSweeps) {
    const Tuning tuning = tuning_of(small_tank("preset = \"yang2009\"\n"));
    const auto sweeps = [](int n) { return Quality{SolverPreset::Yang2009, 13, n}; };
    EXPECT_THAT(tried(tuning), ElementsAre(sweeps(20), sweeps(40), sweeps(80)));
}

TEST_F(TunerTest, TriesWhatTheSceneAsksFor) {
    const Tuning tuning = tuning_of(small_tank("preset = \"yang2009\"\njacobi_sweeps = 4\n"));
    const auto sweeps = [](int n) { return Quality{SolverPreset::Yang2009, 13, n}; };
    EXPECT_THAT(tried(tuning), ElementsAre(sweeps(4), sweeps(20), sweeps(40), sweeps(80)));
}

TEST_F(TunerTest, LeavesLargerGridsAloneOnceOneIsTooSlow) {
    // A cube has all grids from 8 to 128; no machine takes 30 000 steps a second.
    const Scene cube = read_scene(
                           "[tank]\ncells = [8, 8, 8]\n[solver]\ndt_s = 3e-5\n"
                           "[render]\nwidth_px = 32\nheight_px = 24\n",
                           "test.toml")
                           .scene;
    const Tuning tuning = tuning_of(cube);
    EXPECT_EQ(tuning.measured.size(), 3u);
    EXPECT_THAT(tried(tuning), Each(Field(&Quality::cells, 8)));
    EXPECT_EQ(tuning.chosen, 0u) << "nothing keeps the rate: the cheapest";
}

TEST_F(TunerTest, SaysWhatItIsAtAndHowFarItIs) {
    Tuner tuner(gpu, small_tank());
    EXPECT_EQ(tuner.doing(), "fast 13^3, 1 cycle");
    EXPECT_EQ(tuner.tried(), 0u);
    EXPECT_EQ(tuner.most_to_try(), 3u);
    while (tuner.tried() < 1) tuner.work();
    EXPECT_EQ(tuner.doing(), "fast 13^3, 2 cycles");
    while (!tuner.done()) tuner.work();
    EXPECT_EQ(tuner.doing(), "");
    EXPECT_EQ(tuner.tried(), tuner.most_to_try());
    const Tuning before = tuner.tuning();
    tuner.work();
    EXPECT_EQ(tuner.tuning(), before) << "there is nothing left to do";
}

TEST_F(TunerTest, GivesBackTheTexturesItUsed) {
    gpu.free_idle_textures();
    const std::size_t before = gpu.textures().bytes();
    std::size_t most = 0;
    {
        Tuner tuner(gpu, small_tank());
        while (!tuner.done()) {
            tuner.work();
            most = std::max(most, gpu.textures().bytes());
        }
    }
    EXPECT_GT(most, before);
    EXPECT_EQ(gpu.textures().bytes(), before);
}

}  // namespace
}  // namespace eddy
