#include "firmware/stability/long_run_report.h"

#include <gmock/gmock.h>

#include "tests/firmware/stability/complaint.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::stability {
namespace {

using testing::HasSubstr;
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

TEST(LongRunReport, ItsCsvReadsBackAndItsSectionSaysWhatDrifts) {
    std::vector<LongRun> runs{{"stir, 8x8x8 cells, nobody is there", {}}, {"stir, somebody stirs", {}}};
    for (long n = 1; n <= 10; ++n)
        for (LongRun& run : runs)
            run.samples.push_back(
                {.steps = 100 * n,
                 .pressure_mean_pa = 1e-3,
                 .force_mean_n = run.what == "stir, somebody stirs" ? 0.1 * static_cast<double>(n) : 1.0,
                 .memory_mib = 50.25,
                 .textures_made = 7});
    const std::string text = csv_of(runs);
    const std::vector<LongRun> back = long_runs_from_csv(text, "endless.csv");
    ASSERT_EQ(back.size(), 2u);
    EXPECT_EQ(back[1].what, runs[1].what);
    ASSERT_EQ(back[0].samples.size(), 10u);
    EXPECT_EQ(csv_of(back), text);
    const std::string report = report_of(back);
    EXPECT_THAT(report, HasSubstr("| 100 | 0.001 | 0 | 0 | 1 | 0 | 50.2 | 0.00 | 7 |"));
    EXPECT_THAT(report, HasSubstr("| 1000 | "));
    EXPECT_THAT(report, HasSubstr("Nothing drifts."));
    EXPECT_THAT(report, HasSubstr("- mean force [N]: 0.1, then 1"));
    EXPECT_THAT(complaint_about([&] { long_runs_from_csv(text + "x\n", "endless.csv"); }),
                HasSubstr("endless.csv:22: is not what eddy stability --endless writes"));
}

TEST(Drifts, AreNamed) {
    const LongRunSample first{.steps = 100,
                              .pressure_scale_pa = 1000.0,
                              .force_mean_n = 1.0,
                              .memory_mib = 50.0,
                              .textures_made = 7};
    LongRunSample last = first;
    EXPECT_TRUE(drifts({first, last}).empty());
    last.pressure_mean_pa = -0.05;
    EXPECT_TRUE(drifts({first, last}).empty()) << "noise about 0";
    last.force_mean_n = 1.2;
    last.memory_mib = 60.0;
    last.textures_made = 8;
    last.pressure_mean_pa = 0.2;
    EXPECT_EQ(drifts({first, last}).size(), 4u);
    last.smoke_total_m3 = NAN;
    EXPECT_EQ(drifts({first, last}).size(), 5u);
    EXPECT_FALSE(drifts({first}).empty());
}

}  // namespace
}  // namespace eddy::stability
