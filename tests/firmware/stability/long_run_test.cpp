#include "firmware/stability/long_run.h"

#include "tests/gles/gl_fixture.h"

namespace eddy::stability {
namespace {

using LongRunTest = gles::GlTest;

/// The shipped scene on a coarse grid, and in long steps: what a visitor does in two minutes in 1200 of them.
Scene stirred() {
    return load_scene("stir", std::vector<std::string>{"tank.cells=[8, 8, 8]", "solver.dt_s=0.1"}).scene;
}

TEST_F(LongRunTest, IsFlatWhileSomebodyStirs) {
    const std::vector<LongRunSample> samples = long_run(gpu, stirred(), Visitor::Stirs, 3600);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_GT(samples[0].force_mean_n, 0.0);
    EXPECT_GT(samples[0].sent_mean_n, 0.0);
    EXPECT_EQ(drifts(samples), std::vector<std::string>());
}

TEST_F(LongRunTest, AtRestNothingIsFelt) {
    const std::vector<LongRunSample> samples = long_run(gpu, stirred(), Visitor::None, 3600);
    for (const LongRunSample& sample : samples) EXPECT_LT(sample.kinetic_energy_j, 1e-15);
    EXPECT_EQ(drifts(samples), std::vector<std::string>());
}

TEST(Drifts, AreNamed) {
    const LongRunSample first{.steps = 100, .force_mean_n = 1.0, .memory_mib = 50.0, .textures_made = 7};
    LongRunSample last = first;
    EXPECT_TRUE(drifts({first, last}).empty());
    last.force_mean_n = 1.2;
    last.memory_mib = 60.0;
    last.textures_made = 8;
    EXPECT_EQ(drifts({first, last}).size(), 3u);
    last.smoke_total_m3 = NAN;
    EXPECT_EQ(drifts({first, last}).size(), 4u);
    EXPECT_FALSE(drifts({first}).empty());
}

}  // namespace
}  // namespace eddy::stability
