#include "firmware/cost_figures.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// A scene that ran for a second of 50 steps with a hand that trembles along x, every fifth step measured.
class CostFiguresTest : public gles::GlTest {
  protected:
    CostFigures after_a_second(const Scene& scene, bool reset = false) {
        HapticExchange exchange;
        Show show(gpu, scene, exchange);
        Stopwatch stopwatch(gpu);
        StepRate rate;
        for (int n = 1; n <= 50; ++n) {
            exchange.pose.publish({{0.08 + 0.001 * (n % 2), 0.08, 0.08},
                                   glm::dvec3(0.0),
                                   static_cast<std::uint64_t>(n),
                                   n * 20ms,
                                   0,
                                   true});
            stopwatch.set_on(n % 5 == 0);
            show.update(n * 20ms, Seconds(0.02), n % 5 == 0);
            stopwatch.set_on(false);
            rate.add_step();
            show.publish(true);
        }
        if (reset) show.reset();
        return cost_figures(scene, show, stopwatch, rate);
    }

    static Scene scene_with(const std::string& solver, double gain = 1.0) {
        return read_scene(
                   "[tank]\ncells = [16, 16, 12]\nsize_m = [0.16, 0.16, 0.12]\n[[body]]\nradius_m = "
                   "0.025\nmotion = \"held\"\n"
                   "[haptics]\ngain = " +
                       std::to_string(gain) + "\n[solver]\n" + solver + "\n",
                   "test.toml")
            .scene;
    }
};

TEST_F(CostFiguresTest, SayWhatTheFluidIsToldToDo) {
    const CostFigures fast = after_a_second(scene_with("preset = \"fast\"\ncycles = 1\ndt_s = 0.02"));
    EXPECT_EQ(fast.preset, "fast");
    EXPECT_EQ(fast.cells, glm::ivec3(16, 16, 12));
    EXPECT_EQ(fast.iterations, "1 cycle");
    EXPECT_DOUBLE_EQ(fast.target_steps_per_s, 50.0);
    EXPECT_FALSE(fast.force_error);
    const CostFigures paper = after_a_second(scene_with("preset = \"yang2009\"\njacobi_sweeps = 30"));
    EXPECT_EQ(paper.preset, "yang2009");
    EXPECT_EQ(paper.iterations, "30 sweeps");
}

TEST_F(CostFiguresTest, AddUpTheStagesOfAStepWithoutWhatOnlyMeasuredStepsDo) {
    const CostFigures f = after_a_second(scene_with("preset = \"fast\""));
    double sum = 0.0;
    bool pressure = false;
    for (const CostFigures::Stage& stage : f.stages) {
        EXPECT_NE(stage.name, "diagnose");
        EXPECT_GE(stage.ms, 0.0);
        pressure = pressure || stage.name == "pressure";
        sum += stage.ms;
    }
    EXPECT_TRUE(pressure);
    EXPECT_GT(sum, 0.0);
    EXPECT_DOUBLE_EQ(f.step_ms, sum);
    EXPECT_EQ(f.picture_ms, 0.0) << "none was drawn";
    EXPECT_GT(f.divergence_before_1_s, f.divergence_after_1_s);
    EXPECT_GT(f.divergence_after_1_s, 0.0);
}

TEST_F(CostFiguresTest, KnowHowTheForceTremblesInNewtonsOfTheHand) {
    const CostFigures once = after_a_second(scene_with("")), tenfold = after_a_second(scene_with("", 10.0));
    ASSERT_TRUE(once.ripple);
    ASSERT_TRUE(tenfold.ripple);
    EXPECT_GT(once.ripple->rms, 0.0);
    EXPECT_NEAR(tenfold.ripple->rms, 10.0 * once.ripple->rms, 1e-6 * tenfold.ripple->rms);
    EXPECT_NEAR(tenfold.ripple->share, once.ripple->share, 1e-6);
    EXPECT_GT(once.ripple->share, 0.5) << "all that the hand does is tremble";
    EXPECT_FALSE(after_a_second(scene_with(""), true).ripple) << "a fluid that began anew has not trembled";
}

TEST(StepRate, IsThatOfTheMachinesClock) {
    StepRate rate;
    EXPECT_EQ(rate.per_s(), 0.0);
    rate.add_step();
    EXPECT_EQ(rate.per_s(), 0.0);
    for (int i = 0; i < 20; ++i) {
        std::this_thread::sleep_for(5ms);
        rate.add_step();
    }
    // However late the machine wakes a sleeper, it never does too early.
    EXPECT_LE(rate.per_s(), 200.0 * (1.0 + 1e-9));
    EXPECT_GT(rate.per_s(), 0.5);
}

}  // namespace
}  // namespace eddy
