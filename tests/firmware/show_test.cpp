#include "firmware/show.h"

#include "firmware/fluid_setup.h"
#include "firmware/haptic/law.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/gles/gl_fixture.h"
#include "tests/stability/fluid_inside.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr Seconds kDt{0.02};

Scene scene_with(const std::string& more, double gain = 20000.0) {
    return read_scene(
               "[tank]\ncells = [16, 16, 16]\n" + more +
                   "[[body]]\nname = \"ball\"\nradius_m = 0.025\nmotion = \"held\"\n[haptics]\ngain = " +
                   std::to_string(gain) + "\n",
               "test.toml")
        .scene;
}

/// The fluid side alone; the test is the haptic loop.
class ShowTest : public gles::GlTest {
  protected:
    HapticExchange exchange;
    std::uint64_t ticks = 0;

    void hand_at(const glm::dvec3& position, Instant time) {
        exchange.pose.publish({position, glm::dvec3(0.0), ++ticks, time, 0, true});
    }
};

TEST_F(ShowTest, ForceAnswersThePoseItWasComputedFor) {
    Show show(gpu, scene_with(""), exchange);
    EXPECT_EQ(exchange.fluid.newest().sequence, 0u);
    for (int n = 1; n <= 5; ++n) {
        const Instant time = n * 20ms - 3ms;
        hand_at({0.08 + 0.001 * n * n, 0.08, 0.08}, time);
        show.update(n * 20ms, kDt, false);
        show.publish(true);
        const FluidSnapshot& answer = exchange.fluid.newest();
        EXPECT_EQ(answer.sequence, static_cast<std::uint64_t>(n));
        EXPECT_EQ(answer.computed_for, time);
        EXPECT_NEAR(answer.fluid_period.count(), 0.02, 1e-12);
    }
}

TEST_F(ShowTest, AnswersComeOldestFirstEachForItsOwnPose) {
    Show show(gpu, scene_with(""), exchange);
    for (int n = 1; n <= 2; ++n) {
        hand_at({0.08, 0.08, 0.08}, n * 7ms);
        show.update(n * 20ms, kDt, false);
    }
    gles::finish();
    show.publish(true);
    show.publish(true);
    EXPECT_EQ(exchange.fluid.newest().sequence, 2u);
    EXPECT_EQ(exchange.fluid.newest().computed_for, 14ms);
}

TEST_F(ShowTest, ANightIsNoPeriodOfTheFluid) {
    Show show(gpu, scene_with(""), exchange);
    Instant now = 0ms;
    const auto update = [&] {
        hand_at({0.08, 0.08, 0.08}, now);
        show.update(now += 20ms, kDt, false);
        show.publish(true);
    };
    for (int n = 0; n < 10; ++n) update();
    now += 10h;
    update();
    EXPECT_LT(exchange.fluid.newest().fluid_period.count(), 0.2);
    for (int n = 0; n < 50; ++n) update();
    EXPECT_NEAR(exchange.fluid.newest().fluid_period.count(), 0.02, 0.001);
}

TEST_F(ShowTest, FirstPoseIsAPlaceAndNotAMovement) {
    Show show(gpu, scene_with(""), exchange);
    for (int n = 1; n <= 3; ++n) {  // far from where the scene had put the ball, but at rest
        hand_at({0.05, 0.1, 0.06}, n * 20ms);
        show.update(n * 20ms, kDt, false);
        show.publish(true);
        EXPECT_EQ(exchange.fluid.newest().force_n, glm::dvec3(0.0)) << "step " << n;
    }
    EXPECT_EQ(show.figures().most_force_n, 0.0);
    EXPECT_EQ(show.bodies().at(0).centre_m, glm::dvec3(0.05, 0.1, 0.06));
}

TEST_F(ShowTest, FluidResistsAHandThatSetsOff) {
    Show show(gpu, scene_with(""), exchange);
    hand_at({0.08, 0.08, 0.08}, 20ms);
    show.update(20ms, kDt, false);
    show.publish(true);
    hand_at({0.084, 0.08, 0.08}, 40ms);  // 0.2 m/s at once
    show.update(40ms, kDt, false);
    show.publish(true);
    EXPECT_NEAR(show.bodies().at(0).velocity_m_s.x, 0.2, 1e-9);
    const glm::dvec3 force = exchange.fluid.newest().force_n;
    // Half the air it displaces, set moving in one step: 0.5 * 1.2 kg/m3 * 4/3 pi (25 mm)3 * 0.2 m/s / 0.02 s
    // = 0.39 mN. The walls of the small tank add to it.
    EXPECT_LT(force.x, -0.3e-3);
    EXPECT_GT(force.x, -0.8e-3);
    EXPECT_LT(std::abs(force.y), 0.02e-3);
}

TEST_F(ShowTest, AGpuSlowerThanTheClockLosesNoAnswer) {
    Show prompt(gpu, scene_with(""), exchange);
    const auto stir = [&](Show& show, int n) {
        hand_at({0.08 + 0.002 * std::sin(n), 0.08, 0.08}, n * 20ms - 3ms);
        show.update(n * 20ms, kDt, false);
    };
    for (int n = 1; n <= 8; ++n) {
        stir(prompt, n);
        prompt.publish(true);
    }
    const FluidSnapshot expected = exchange.fluid.newest();
    Show late(gpu, scene_with(""), exchange);
    for (int n = 1; n <= 8; ++n) stir(late, n);
    EXPECT_GE(exchange.fluid.newest().sequence, 5u) << "handed on as room is made";
    gles::finish();
    for (int n = 0; n < 3; ++n) late.publish(true);
    EXPECT_EQ(exchange.fluid.newest().sequence, 8u);
    EXPECT_EQ(exchange.fluid.newest().received_j, expected.received_j) << "none is missing in the books";
}

TEST_F(ShowTest, AnAnswerComesWithTheMotionItBelongsToAndTheFluidKeepsBooks) {
    Show show(gpu, scene_with(""), exchange);
    const double way_m[] = {0.0, 0.004, 0.008, 0.008, 0.008};  // off at 0.2 m/s, and to rest again
    double received_j = 0.0, most_j = 0.0;
    glm::dvec3 before(0.0);
    for (int n = 1; n <= 5; ++n) {
        hand_at({0.076 + way_m[n - 1], 0.08, 0.08}, n * 20ms);
        show.update(n * 20ms, kDt, false);
        show.publish(true);
        const FluidSnapshot answer = exchange.fluid.newest();
        const double v = n == 1 ? 0.0 : (way_m[n - 1] - way_m[n - 2]) / 0.02;
        EXPECT_NEAR(answer.velocity_m_s.x, v, 1e-9) << n;
        EXPECT_NEAR(answer.acceleration_m_s2.x, (v - before.x) / 0.02, 1e-6) << n;
        received_j -= answer.force_n.x * 0.5 * (v + before.x) * 0.02;
        EXPECT_NEAR(answer.received_j, received_j, 1e-6 * std::abs(received_j) + 1e-15) << n;
        most_j = std::max(most_j, received_j);
        before.x = v;
    }
    // What it took to set the air moving, 1/2 m v2 of half the air displaced, comes back in part when the ball stops.
    EXPECT_GT(most_j, 0.5 * 0.5 * 0.5 * 1.2 * 65.4e-6 * 0.04);
    EXPECT_LT(received_j, 0.8 * most_j);
    EXPECT_GT(received_j, 0.0);
}

TEST_F(ShowTest, MeasuringHowSteeplyTheFluidAnswersLeavesItAtItsStart) {
    Show once(gpu, scene_with(""), exchange), measured(gpu, scene_with(""), exchange);
    EXPECT_GT(measured.slopes().added_kg, 0.0);
    glm::dvec3 forces[2];
    for (Show* show : {&once, &measured}) {
        for (int n = 1; n <= 3; ++n) {
            hand_at({0.08 + 0.001 * n, 0.08, 0.08}, n * 20ms);
            show->update(n * 20ms, kDt, false);
            show->publish(true);
        }
        forces[show == &once ? 0 : 1] = exchange.fluid.newest().force_n;
    }
    EXPECT_EQ(forces[0], forces[1]);
    EXPECT_NE(forces[0], glm::dvec3(0.0));
}

TEST_F(ShowTest, AfterAStallTheBodyIsPlacedWhereTheHandIsAtRest) {
    Show show(gpu, scene_with(""), exchange);
    for (int n = 1; n <= 3; ++n) {
        hand_at({0.07, 0.08, 0.08}, n * 20ms);
        show.update(n * 20ms, kDt, false);
        show.publish(true);
    }
    hand_at({0.09, 0.08, 0.08}, 560ms);  // half a second later, 20 mm on
    show.update(560ms, kDt, false);
    show.publish(true);
    EXPECT_EQ(show.bodies().at(0).centre_m, glm::dvec3(0.09, 0.08, 0.08));
    EXPECT_EQ(show.bodies().at(0).velocity_m_s, glm::dvec3(0.0));
    EXPECT_LT(glm::length(exchange.fluid.newest().force_n), 1e-9);
}

TEST_F(ShowTest, AHandThatIsNotKnownLeavesTheBodyWhereItIs) {
    Show show(gpu, scene_with(""), exchange);
    hand_at({0.07, 0.08, 0.08}, 20ms);
    show.update(20ms, kDt, false);
    exchange.pose.publish({glm::dvec3(0.0), glm::dvec3(0.0), ++ticks, 40ms, 0, false});
    show.update(40ms, kDt, false);
    EXPECT_EQ(show.bodies().at(0).centre_m, glm::dvec3(0.07, 0.08, 0.08));
    EXPECT_EQ(show.bodies().at(0).velocity_m_s, glm::dvec3(0.0));
    show.publish(true);
    show.publish(true);
}

TEST_F(ShowTest, ShowsBodiesWhereTheFluidTookThemAndTheHandWhereItIs) {
    Show show(gpu,
              read_scene("[tank]\ncells = [16, 16, 16]\n[fluid]\ngravity_m_s2 = [0, -9.81, 0]\n"
                         "[[body]]\nshape = \"ellipsoid\"\nradii_m = [0.02, 0.03, 0.02]\nmotion = \"held\"\n"
                         "turning = true\nangle_deg = 30\n"
                         "[[body]]\nradius_m = 0.02\ncentre_m = [0.04, 0.08, 0.04]\nmotion = \"free\"\n"
                         "density_kg_m3 = 0.12\n",
                         "test.toml")
                  .scene,
              exchange);
    const glm::dquat start = show.bodies().at(0).orientation;
    for (int n = 1; n <= 4; ++n) {
        hand_at({0.08 + 0.002 * n * n, 0.08, 0.12}, n * 20ms);
        show.update(n * 20ms, kDt, false);
    }
    EXPECT_GT(show.bodies().at(1).centre_m.y, 0.081) << "lighter than air, it rises";
    EXPECT_EQ(show.bodies().at(0).centre_m, glm::dvec3(0.112, 0.08, 0.12));
    EXPECT_NE(show.bodies().at(0).orientation, start) << "the air turns it";
    show.reset();
    EXPECT_EQ(show.bodies().at(1).centre_m, glm::dvec3(0.04, 0.08, 0.04));
}

/// Forces while a hand goes round in a circle once a second, and the greatest change from one to the next; before each step
/// `at` may do something to the show.
struct Stirred {
    std::vector<glm::dvec3> forces;
    double greatest_change = 0.0;
};
Stirred stir(Show& show, HapticExchange& exchange, int steps, const std::function<void(int)>& at) {
    Stirred stirred;
    for (int n = 1; n <= steps; ++n) {
        const double angle = 2.0 * 3.14159265358979 * 0.02 * n;
        exchange.pose.publish({{0.08 + 0.02 * std::cos(angle), 0.08 + 0.02 * std::sin(angle), 0.08},
                               glm::dvec3(0.0),
                               static_cast<std::uint64_t>(n),
                               n * 20ms,
                               0,
                               true});
        at(n);
        show.update(n * 20ms, kDt, n == steps);
        show.publish(true);
        const glm::dvec3 force = exchange.fluid.newest().force_n;
        if (n > 10)  // after the start
            stirred.greatest_change =
                std::max(stirred.greatest_change, glm::length(force - stirred.forces.back()));
        stirred.forces.push_back(force);
    }
    return stirred;
}

TEST_F(ShowTest, PresetAndGridMayChangeUnderAStirringHandWithoutAJumpInForce) {
    constexpr int kSteps = 90;
    const Scene scene = scene_with("[smoke]\ninitial = \"1\"\n");
    HapticExchange own;
    Show show(gpu, scene, own);
    const Quality fast = show.quality();
    const std::vector<Quality> all{fast,
                                   with_preset(fast, SolverPreset::Precise),
                                   with_preset(fast, SolverPreset::Yang2009),
                                   {SolverPreset::Fast, 24, 2}};
    double of_itself =
        0.0;  // change from step to step without a switch: the hand's, and what trembles in the settings
    Stirred plain;
    for (const Quality& quality : all) {
        HapticExchange alone;
        Show steady(gpu, with_quality(scene, quality), alone);
        const Stirred stirred = stir(steady, alone, kSteps, [](int) {});
        if (quality == fast) plain = stirred;
        of_itself = std::max(of_itself, stirred.greatest_change);
    }
    show.warm_up(all);
    const Stirred switched = stir(show, own, kSteps, [&](int n) {
        if (n % 20 == 0) show.set_quality(all[static_cast<std::size_t>(n / 20) % all.size()]);
    });
    for (std::size_t n = 20; n < kSteps; n += 20)
        for (std::size_t i = n; i < n + 5; ++i)
            EXPECT_LT(glm::length(switched.forces[i] - switched.forces[i - 1]), 1.2 * of_itself)
                << "step " << i + 1;
    for (const glm::dvec3& force : switched.forces) EXPECT_TRUE(std::isfinite(glm::length(force)));
    EXPECT_EQ(show.quality(), fast);
    EXPECT_EQ(show.figures().steps, kSteps);
    // Half a second after the last change it is the force of the fluid again: within what four settings have made of the flow.
    EXPECT_LT(glm::length(switched.forces.back() - plain.forces.back()),
              0.5 * glm::length(plain.forces.back()));
}

TEST_F(ShowTest, AnswersGoOnWithoutAGapWhenThePresetChanges) {
    Show show(gpu, scene_with(""), exchange);
    show.warm_up({show.quality(), with_preset(show.quality(), SolverPreset::Precise)});
    stir(show, exchange, 12, [&](int n) {
        if (n == 6) show.set_quality(with_preset(show.quality(), SolverPreset::Precise));
        EXPECT_EQ(exchange.fluid.newest().sequence, static_cast<std::uint64_t>(n - 1));
    });
}

TEST_F(ShowTest, WarmingUpLeavesTheFluidAtItsStart) {
    const Scene scene = scene_with("");
    HapticExchange a, b;
    Show first(gpu, scene, a), second(gpu, scene, b);
    second.warm_up({second.quality(), {SolverPreset::Fast, 24, 1}});
    EXPECT_EQ(stir(first, a, 12, [](int) {}).forces, stir(second, b, 12, [](int) {}).forces);
}

TEST_F(ShowTest, WhileItRestsTheLastForceStaysTheAnswer) {
    Show show(gpu, scene_with(""), exchange);
    stir(show, exchange, 12, [](int) {});
    const FluidSnapshot before = exchange.fluid.newest();
    hand_at({0.1, 0.08, 0.08}, 260ms);
    show.rest(260ms);
    const FluidSnapshot& after = exchange.fluid.newest();
    EXPECT_EQ(after.force_n, before.force_n);
    EXPECT_EQ(after.computed_for, 260ms);
    EXPECT_EQ(show.figures().steps, 12);
    EXPECT_EQ(show.figures().rested, 1);
    // Waking, a movement since the last look is a movement.
    hand_at({0.102, 0.08, 0.08}, 280ms);
    show.update(280ms, kDt, false);
    EXPECT_GT(glm::length(show.bodies().at(0).velocity_m_s), 0.0);
}

TEST_F(ShowTest, RestKeepsTheFluidAliveForTheHapticLoop) {
    Show show(gpu, scene_with(""), exchange);
    stir(show, exchange, 12, [](int) {});
    LawState state;
    for (int n = 0; n < 2000; ++n) {  // two seconds
        const Instant now = 240ms + n * 1ms;
        if (n % 20 == 0) show.rest(now);
        HapticInput in;
        in.now = now;
        in.fluid = exchange.fluid.newest();
        in.orders.enabled = true;
        in.device = HapticState::Ready;
        in.reading = HandleReading{glm::dvec3(0.0), 0, now};
        EXPECT_NE(law(state, in, 1ms).reason, GateReason::FluidStale) << n << " ms";
    }
}

TEST_F(ShowTest, AnAnswerThatIsNoneLeavesTheLastOneStanding) {
    Show show(gpu, scene_with(""), exchange);
    stir(show, exchange, 12, [](int) {});
    const FluidSnapshot good = exchange.fluid.newest();
    const auto step = [&](int n) {
        const double angle = 2.0 * 3.14159265358979 * 0.02 * n;  // on with the circle
        hand_at({0.08 + 0.02 * std::cos(angle), 0.08 + 0.02 * std::sin(angle), 0.08}, n * 20ms);
        show.update(n * 20ms, kDt, false);
        show.publish(true);
        return exchange.fluid.newest();
    };
    gles::poison(gles::inside(show.fluid()).on_faces->texture(), {3, 4},
                 std::numeric_limits<float>::quiet_NaN());
    const FluidSnapshot held = step(13);
    EXPECT_EQ(held.sequence, good.sequence);
    EXPECT_EQ(held.force_n, good.force_n);
    EXPECT_EQ(show.guards().unsound_steps, 1);
    const FluidSnapshot next = step(14);
    EXPECT_EQ(next.sequence, good.sequence + 1);
    EXPECT_LT(glm::length(next.force_n), 4.0 * glm::length(good.force_n));
    EXPECT_EQ(show.guards().unsound_steps, 1);
}

TEST_F(ShowTest, ASlowFrameIsMadeUpForInStepsAlongTheHandsWay) {
    Show show(gpu, scene_with(""), exchange);
    Instant now{0};
    double x = 0.07;
    const auto update = [&](Instant dt) {  // at 0.1 m/s
        now += dt;
        x += 0.1 * Seconds(dt).count();
        hand_at({x, 0.08, 0.08}, now);
        show.update(now, dt, false);
        show.publish(true);
    };
    for (int n = 0; n < 10; ++n) update(20ms);
    const glm::dvec3 before = exchange.fluid.newest().force_n;
    const long steps = show.fluid().steps();
    update(80ms);
    EXPECT_EQ(show.fluid().steps(), steps + 4);
    EXPECT_EQ(show.figures().steps, 11);
    EXPECT_EQ(show.figures().sub_steps, 3);
    EXPECT_NEAR(show.bodies().at(0).centre_m.x, x, 1e-12);
    EXPECT_NEAR(show.bodies().at(0).velocity_m_s.x, 0.1, 1e-9);
    EXPECT_EQ(exchange.fluid.newest().computed_for, now) << "the last of them is the answer";
    EXPECT_LT(glm::length(exchange.fluid.newest().force_n - before), 0.5 * glm::length(before) + 1e-5);
    gles::finish();
    show.publish(false);
    update(20ms);
    EXPECT_EQ(show.fluid().steps(), steps + 5);
    EXPECT_EQ(exchange.fluid.newest().computed_for, now);
}

TEST_F(ShowTest, AHandThatSetsOffDuringAStallFeelsTheAddedMassOfIt) {
    // Without viscosity and from rest, the force of one update is the added mass times the change of velocity, over its time.
    const auto felt = [this](int stalled) {
        Show show(gpu, scene_with(""), exchange);
        Instant now{0};
        for (int n = 0; n < 5; ++n) {
            hand_at({0.08, 0.08, 0.08}, now += 20ms);
            show.update(now, kDt, false);
            show.publish(true);
        }
        const Instant dt = stalled * 20ms;
        hand_at({0.08 + 0.1 * Seconds(dt).count(), 0.08, 0.08}, now += dt);
        show.update(now, dt, false);
        show.publish(true);
        return exchange.fluid.newest();
    };
    const FluidSnapshot usual = felt(1), late = felt(4);
    EXPECT_NEAR(late.acceleration_m_s2.x, 0.1 / 0.08, 1e-9);
    EXPECT_NEAR(late.velocity_m_s.x, 0.1, 1e-9);
    EXPECT_NEAR(late.force_n.x / late.acceleration_m_s2.x, usual.force_n.x / usual.acceleration_m_s2.x,
                -0.3 * usual.force_n.x / usual.acceleration_m_s2.x);
}

TEST_F(ShowTest, AMachineThatIsAlwaysSlowTakesOneStepAtATime) {
    Show show(gpu, scene_with(""), exchange);
    for (int n = 1; n <= 10; ++n) {
        hand_at({0.08, 0.08, 0.08}, n * 100ms);
        show.update(n * 100ms, Seconds(0.1), false);
        show.publish(true);
    }
    EXPECT_EQ(show.fluid().steps(), 10);
    EXPECT_EQ(show.figures().sub_steps, 0);
}

TEST_F(ShowTest, AHandThatLeapsIsPlacedAndPushesNothing) {
    for (const double leap_m : {0.004, 0.07}) {
        HapticExchange own;
        Show show(gpu, scene_with(""), own);
        for (int n = 1; n <= 4; ++n) {
            own.pose.publish({{n < 3 ? 0.04 : 0.04 + leap_m, 0.08, 0.08},
                              glm::dvec3(0.0),
                              static_cast<std::uint64_t>(n),
                              n * 20ms,
                              0,
                              true});
            show.update(n * 20ms, kDt, false);
            show.publish(true);
            if (n != 3) continue;
            const bool leaps = leap_m > 0.05;
            EXPECT_EQ(show.bodies().at(0).centre_m.x, 0.04 + leap_m);
            EXPECT_EQ(show.bodies().at(0).velocity_m_s.x > 0.0, !leaps);
            EXPECT_EQ(show.figures().placed, leaps ? 1 : 0);
            if (leaps) {
                EXPECT_LT(glm::length(own.fluid.newest().force_n), 1e-9);
            }
        }
        EXPECT_TRUE(std::isfinite(glm::length(own.fluid.newest().force_n)));
    }
}

TEST_F(ShowTest, AfterAResetNoForceOfBeforeLingers) {
    Show show(gpu, scene_with(""), exchange);
    stir(show, exchange, 12, [](int) {});
    show.set_quality(with_preset(show.quality(), SolverPreset::Precise));
    show.reset();
    for (int n = 1; n <= 3; ++n) {  // at rest from the start
        hand_at({0.08, 0.08, 0.08}, 1s + n * 20ms);
        show.update(1s + n * 20ms, kDt, false);
        show.publish(true);
        EXPECT_LT(glm::length(exchange.fluid.newest().force_n), 1e-9);
    }
}

TEST_F(ShowTest, ScenesOwnPresetIsTheSceneAsItIsWritten) {
    const Scene scene =
        scene_with("[solver]\npreset = \"fast\"\nadvection = \"maccormack\"\ntime_order = 2\n");
    const Quality own = quality_of(scene);
    Show show(gpu, scene, exchange, with_preset(own, SolverPreset::Precise));
    EXPECT_EQ(show.quality().preset, SolverPreset::Precise);
    show.set_quality(own);
    EXPECT_EQ(show.fluid().setup().solver.time_order, 2);
    EXPECT_EQ(show.fluid().setup().solver.advection, gles::Advection::MacCormack);
}

TEST_F(ShowTest, FiguresRangeOverTheForceAfterGain) {
    for (const double gain : {1.0, 20000.0}) {
        HapticExchange own;
        Show before(gpu, scene_with("", gain), own), show(gpu, scene_with("", gain), own);
        own.pose.publish({{0.07, 0.08, 0.08}, glm::dvec3(0.0), 1, 0ms, 0, true});
        before.update(0ms, kDt, false);
        before.publish(true);
        show.follow(before);
        EXPECT_FALSE(show.figures().least_force_n);
        double least = 1e9, most = 0.0;
        for (int n = 1; n <= 6; ++n) {
            own.pose.publish({{0.07 + 0.0005 * n * n, 0.08, 0.08},
                              glm::dvec3(0.0),
                              static_cast<std::uint64_t>(n),
                              n * 20ms,
                              0,
                              true});
            show.update(n * 20ms, kDt, n == 3);
            show.publish(true);
            const double felt = gain * glm::length(own.fluid.newest().force_n);
            least = std::min(least, felt);
            most = std::max(most, felt);
        }
        EXPECT_GT(most, 0.0);
        EXPECT_DOUBLE_EQ(show.figures().least_force_n.value_or(-1.0), least);
        EXPECT_DOUBLE_EQ(show.figures().most_force_n, most);
        EXPECT_GT(show.figures().divergence_before_1_s, show.figures().divergence_after_1_s);
        EXPECT_EQ(show.figures().steps, 6);
    }
}

TEST_F(ShowTest, WithoutAHandNothingIsPublished) {
    const Scene scene = read_scene("[tank]\ncells = [16, 16, 16]\n", "test.toml").scene;
    Show show(gpu, scene, exchange);
    for (int n = 1; n <= 3; ++n) {
        show.update(n * 20ms, kDt, true);
        show.publish(true);
    }
    EXPECT_EQ(exchange.fluid.newest().sequence, 0u);
    EXPECT_EQ(show.figures().steps, 3);
}

TEST_F(ShowTest, MeasuresNoForceThatOnlyAFileWouldTell) {
    Show show(gpu, scene_with("[outputs]\nforce_methods = true\n"), exchange);
    show.update(20ms, kDt, false);
    EXPECT_TRUE(show.fluid().force_methods().empty());
}

TEST(HapticOrders, KeepTheBallInTheTankAndCarryTheScenesGain) {
    const Scene scene = scene_with("");
    const HapticOrders orders = orders_for(scene, fluid_setup(scene));
    EXPECT_TRUE(orders.enabled);
    EXPECT_EQ(orders.gain, 20000.0);
    EXPECT_EQ(orders.tank_from_device.centre_m, scene.haptics.centre_m);
    EXPECT_EQ(orders.tank_from_device.scale, scene.haptics.workspace_scale);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(orders.lowest_m[axis], 0.025 + 1.5 * 0.01, 1e-12);
        EXPECT_NEAR(orders.highest_m[axis], 0.16 - 0.025 - 1.5 * 0.01, 1e-12);
    }
}

TEST(HapticOrders, LetARodCloserWithItsSideUnlessItTurnsInTheHand) {
    for (const bool turns : {false, true}) {
        const Scene scene =
            read_scene(
                std::string("[tank]\ncells = [16, 16, 16]\n[[body]]\nshape = \"capsule\"\nradius_m = 0.01\n"
                            "length_m = 0.04\nmotion = \"held\"\n") +
                    (turns ? "turning = true\n" : ""),
                "test.toml")
                .scene;
        const HapticOrders orders = orders_for(scene, fluid_setup(scene));
        EXPECT_NEAR(orders.lowest_m.y, 0.03 + 1.5 * 0.01, 1e-12);
        EXPECT_NEAR(orders.lowest_m.x, (turns ? 0.03 : 0.01) + 1.5 * 0.01, 1e-12);
        EXPECT_NEAR(orders.highest_m.x, 0.16 - orders.lowest_m.x, 1e-12);
    }
}

TEST(HapticOrders, HoldABallThatFillsTheTankInItsMiddle) {
    const Scene scene =
        read_scene("[tank]\ncells = [16, 16, 16]\n[[body]]\nradius_m = 0.09\nmotion = \"held\"\n",
                   "test.toml")
            .scene;
    const HapticOrders orders = orders_for(scene, fluid_setup(scene));
    EXPECT_EQ(orders.lowest_m, orders.highest_m);
    EXPECT_EQ(orders.lowest_m, 0.5 * scene.tank.size_m);
}

}  // namespace
}  // namespace eddy
