#include "firmware/step_timer.h"

#include <algorithm>

#include "firmware/scene_steps.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using StepTimerTest = gles::GlTest;

void work_for(double cpu_ms) {
    for (const auto begin = Stopwatch::now(); Stopwatch::now().cpu_ms < begin.cpu_ms + cpu_ms;) {
    }
}

TEST_F(StepTimerTest, ChargesAStepWithItsWorkAndItsWaitingAndNotWithTheWarmUp) {
    std::string order;
    const auto take = [&] {
        order += 't';
        work_for(order.size() > 2 * kWarmUpSteps ? 5.0 : 40.0);
    };
    const auto wait = [&] {
        order += 'w';
        work_for(5.0);
    };
    StepTimer timer(gpu, take, wait);
    timer.warm_up();
    EXPECT_TRUE(timer.times().empty());
    timer.time_step();
    work_for(200.0);
    timer.time_step();
    EXPECT_EQ(order, "twtwtwtwtwtwtw");
    ASSERT_EQ(timer.times().cpu_ms.size(), 2u);
    ASSERT_EQ(timer.times().wall_ms.size(), 2u);
    for (const double ms : timer.times().cpu_ms) {
        EXPECT_GE(ms, 10.0);
        EXPECT_LT(ms, 200.0);
    }
    EXPECT_EQ(timer.times().gpu_ms.size(), gpu.capabilities().timer_query ? 2u : 0u);
}

TEST_F(StepTimerTest, OfTheGpuTakesNoMoreThanTheWall) {
    if (!gpu.capabilities().timer_query)
        GTEST_SKIP() << "skipped: this driver lacks EXT_disjoint_timer_query";
    const std::vector<std::string> small{"tank.cells=[16,16,16]"};
    const Scene scene = load_scene("bench", small).scene;
    SceneSteps steps(gpu, scene);
    StepTimer timer(
        gpu, [&] { steps.take(); }, [&] { steps.wait(); });
    timer.warm_up();
    for (int i = 0; i < 5; ++i) timer.time_step();
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_GT(timer.times().gpu_ms.at(i), 0.0);
        EXPECT_LE(timer.times().gpu_ms.at(i), timer.times().wall_ms.at(i));
    }
}

using SceneStepsTest = gles::GlTest;

TEST_F(SceneStepsTest, MeasureWhatTheSceneAsksForAndTheTankWhenAsked) {
    const std::vector<std::string> small{"tank.cells=[16,16,16]"};
    const Scene with_body = load_scene("bench", small).scene;
    SceneSteps stirred(gpu, with_body);
    stirred.take();
    const gles::StepResult first = stirred.wait();
    EXPECT_EQ(first.step, 1);
    EXPECT_FALSE(first.diagnostics);
    stirred.take(true);
    const gles::StepResult second = stirred.wait();
    EXPECT_EQ(second.step, 2);
    EXPECT_TRUE(second.diagnostics);

    Scene without = with_body;
    without.bodies.clear();
    SceneSteps still(gpu, without);
    still.take();
    EXPECT_FALSE(still.wait().diagnostics);
    still.take(true);
    EXPECT_TRUE(still.wait().diagnostics);
}

}  // namespace
}  // namespace eddy
