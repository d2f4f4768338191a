#include "firmware/stopwatch.h"

#include <algorithm>
#include <random>

#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

std::vector<double> shuffled(int n) {
    std::vector<double> values;
    for (int i = 1; i <= n; ++i) values.push_back(i);
    std::shuffle(values.begin(), values.end(), std::mt19937(3));
    return values;
}

TEST(Median, LiesInTheMiddleOfAnyOrder) {
    EXPECT_EQ(median({}), 0.0);
    EXPECT_EQ(median({5.0}), 5.0);
    for (const int n : {3, 9, 101}) EXPECT_EQ(median(shuffled(n)), (n + 1) / 2);
    for (const int n : {2, 10, 100}) EXPECT_EQ(median(shuffled(n)), n / 2 + 1);
}

TEST(Percentile95, IsTheLeastValueThatSoManyDoNotExceed) {
    EXPECT_EQ(percentile_95({}), 0.0);
    for (int n = 1; n <= 200; ++n) {
        const double p = percentile_95(shuffled(n));  // as many values do not exceed p as p says
        EXPECT_GE(p, 0.95 * n - 1e-9) << n;
        EXPECT_LT(p - 1.0, 0.95 * n - 1e-9) << n;
    }
}

using StopwatchTest = gles::GlTest;

TEST_F(StopwatchTest, TimesEachStageOnceAStepWhileItIsOnInTheOrderTheyFirstRan) {
    Stopwatch stopwatch(gpu);
    const auto step = [&] {
        { const gles::Gpu::Stage stage(gpu, "second in the alphabet"); }
        { const gles::Gpu::Stage stage(gpu, "first"); }
        { const gles::Gpu::Stage stage(gpu, "first"); }
    };
    step();
    EXPECT_TRUE(stopwatch.stages().empty());
    for (int i = 0; i < 2; ++i) {
        stopwatch.set_on(true);
        step();
        stopwatch.set_on(false);
    }
    step();
    EXPECT_EQ(stopwatch.stages(), (std::vector<std::string>{"second in the alphabet", "first"}));
    EXPECT_EQ(stopwatch.of("first").wall_ms.size(), 2u);
    EXPECT_EQ(stopwatch.of("first").cpu_ms.size(), 2u);
    for (const double ms : stopwatch.of("first").wall_ms) EXPECT_GE(ms, 0.0);
}

TEST_F(StopwatchTest, GoesOnWhenAnotherThatWasOnBeforeIsGone) {
    auto before = std::make_unique<Stopwatch>(gpu);
    Stopwatch stopwatch(gpu);
    const auto step = [&](Stopwatch& timed) {
        timed.set_on(true);
        { const gles::Gpu::Stage stage(gpu, "only"); }
        timed.set_on(false);
    };
    step(*before);
    step(stopwatch);
    step(*before);
    before.reset();
    step(stopwatch);
    ASSERT_FALSE(stopwatch.stages().empty());
    EXPECT_EQ(stopwatch.of("only").wall_ms.size(), 2u);
}

TEST_F(StopwatchTest, ChargesTimeToTheStageThatSpentIt) {
    Stopwatch stopwatch(gpu);
    stopwatch.set_on(true);
    {
        const gles::Gpu::Stage stage(gpu, "slow");
        for (const auto begin = Stopwatch::now(); Stopwatch::now().cpu_ms < begin.cpu_ms + 20.0;) {
        }
    }
    { const gles::Gpu::Stage stage(gpu, "quick"); }
    EXPECT_GE(stopwatch.of("slow").cpu_ms.at(0), 20.0);
    EXPECT_GE(stopwatch.of("slow").wall_ms.at(0),
              20.0 / 64);  // many threads may spend processor time at once
    EXPECT_LT(stopwatch.of("quick").cpu_ms.at(0), 20.0);
}

}  // namespace
}  // namespace eddy
