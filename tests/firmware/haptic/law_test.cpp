#include "firmware/haptic/law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace eddy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A hand at rest in the middle of a 0.2 m tank, a fluid at 50 Hz that pushes with 2 N upwards, and a law at
/// 1 kHz.
struct Bench {
    LawState state;
    HapticInput in{.device = HapticState::Ready,
                   .fluid = {.force_n = {0.0, 2.0, 0.0}, .fluid_period = Seconds(0.020)},
                   .orders = {.enabled = true,
                              .tank_from_device = {.centre_m = glm::dvec3(0.1), .scale = 2.0},
                              .lowest_m = glm::dvec3(0.02),
                              .highest_m = glm::dvec3(0.18)}};
    glm::dvec3 handle_m{0.0};
    bool answering = true;
    bool fluid_runs = true;
    std::int64_t ticks = 0;
    Instant last_reply{0};

    LawOutput tick() {
        ++ticks;
        in.now = std::chrono::milliseconds(ticks);
        in.reading.reset();
        if (answering) {
            in.reading = HandleReading{.position_m = handle_m, .buttons = 5, .taken_at = in.now};
            last_reply = in.now;
        }
        in.silence = in.now - last_reply;
        const std::int64_t fluid_ticks = std::llround(in.fluid.fluid_period.count() * 1000.0);
        if (fluid_runs && (ticks - 1) % fluid_ticks == 0) ++in.fluid.sequence;
        return law(state, in, kNominalTick);
    }
    LawOutput run(int n) {
        LawOutput out;
        for (int i = 0; i < n; ++i) out = tick();
        return out;
    }
};

TEST(Law, RawForceIsGainTimesTheFluidsAndIsHeldBetweenUpdates) {
    Bench bench;
    bench.in.orders.gain = 1.5;
    for (int i = 0; i < 50; ++i) EXPECT_EQ(bench.tick().raw_n, glm::dvec3(0.0, 3.0, 0.0));
}

TEST(Law, BringsASteadyForceToTheHandWhole) {
    Bench bench;
    const LawOutput out = bench.run(2000);
    EXPECT_NEAR(glm::length(out.force_n - glm::dvec3(0.0, 2.0, 0.0)), 0.0, 1e-12);
    EXPECT_EQ(out.reason, GateReason::Open);
}

TEST(Law, PoseIsTheHandleCarriedIntoTheTank) {
    Bench bench;
    for (int i = 0; i < 200; ++i) {
        bench.handle_m = glm::dvec3(0.1e-3 * i, 0.0, -0.05e-3 * i);  // 0.1, 0, -0.05 m/s
        const LawOutput out = bench.tick();
        // Between the steps of an encoder, where it most likely is.
        EXPECT_LE(glm::length(out.pose.position_m - (glm::dvec3(0.1) + 2.0 * bench.handle_m)),
                  2.0 * MotionTracker::kExpectedM * (1.0 + 1e-9));
        EXPECT_EQ(out.pose.sequence, static_cast<std::uint64_t>(i + 1));
        EXPECT_EQ(out.pose.time, bench.in.now);
        EXPECT_EQ(out.pose.buttons, 5);
    }
    EXPECT_NEAR(glm::length(bench.tick().pose.velocity_m_s), 0.22, 0.05);
    const PoseSnapshot rests = bench.run(1000).pose;
    EXPECT_NEAR(glm::length(rests.position_m - (glm::dvec3(0.1) + 2.0 * bench.handle_m)), 0.0, 1e-9);
}

TEST(Law, TheFluidSeesNoStepsOfTheEncoders) {
    const double count_m = 63.5e-6;
    for (const ForceLaw force : {ForceLaw::Filter, ForceLaw::Model}) {
        Bench bench;
        bench.state.force = HandForce(force, {});
        double before = 0.0, most_off = 0.0;
        for (int i = 0; i < 1000; ++i) {
            bench.handle_m.x =
                count_m * std::round(0.02e-3 * i / count_m);  // 0.02 m/s, a count in three ticks
            const double x = bench.tick().pose.position_m.x;
            if (i >= 500) most_off = std::max(most_off, std::abs(x - before - 2.0 * 0.02e-3));
            before = x;
        }
        EXPECT_LT(most_off, 0.1 * 2.0 * count_m);  // as it is read, 2/3 of a count
    }
}

TEST(Law, BodyStaysInsideItsBoundsAndStandsStillAgainstThem) {
    Bench bench;
    LawOutput out;
    for (int i = 0; i < 200; ++i) {
        bench.handle_m = glm::dvec3(0.5e-3, 0.1e-3, -0.5e-3) * static_cast<double>(i);
        out = bench.tick();
        EXPECT_LE(out.pose.position_m.x, 0.18);
        EXPECT_GE(out.pose.position_m.z, 0.02);
    }
    EXPECT_EQ(out.pose.position_m.x, 0.18);
    EXPECT_EQ(out.pose.position_m.z, 0.02);
    EXPECT_EQ(out.pose.velocity_m_s.x, 0.0);
    EXPECT_EQ(out.pose.velocity_m_s.z, 0.0);
    EXPECT_NEAR(out.pose.velocity_m_s.y, 0.2, 1e-6);  // along the bounds it slides
}

TEST(Law, AnswersNothingBeforeTheFirstFluidSnapshot) {
    Bench bench;
    bench.fluid_runs = false;
    const LawOutput out = bench.run(50);
    EXPECT_EQ(out.force_n, glm::dvec3(0.0));
    EXPECT_EQ(out.reason, GateReason::FluidStale);
}

TEST(Law, ReplyMissingFor20msZeroesAndLatches) {
    Bench bench;
    bench.run(2000);
    bench.answering = false;
    EXPECT_NEAR(bench.run(19).force_n.y, 2.0, 1e-12);  // silent for 19 ms: holds
    EXPECT_EQ(bench.tick().force_n, glm::dvec3(0.0));  // 20 ms
    EXPECT_EQ(bench.tick().reason, GateReason::DeviceSilent);

    bench.answering = true;
    EXPECT_EQ(bench.run(3000).force_n, glm::dvec3(0.0));
    EXPECT_EQ(bench.tick().reason, GateReason::DeviceSilent);

    ++bench.in.orders.resets;
    EXPECT_EQ(bench.tick().reason, GateReason::Starting);
    EXPECT_NEAR(bench.run(2000).force_n.y, 2.0, 1e-12);
}

TEST(Law, ATickThatComesLateIsNotTheDevicesSilence) {
    // For 30 ms nobody asked the device, so its last reply is 30 ms old; it answers again in the tick after.
    Bench bench;
    bench.run(2000);
    bench.ticks += 30;
    bench.in.now = std::chrono::milliseconds(bench.ticks);
    bench.in.reading.reset();
    bench.in.silence = bench.in.now - bench.last_reply;
    EXPECT_EQ(law(bench.state, bench.in, Seconds(0.030)).reason, GateReason::Open);
    EXPECT_EQ(bench.run(10).reason, GateReason::Open);
}

TEST(Law, ADeviceThatNeverAnsweredIsNotReadyRatherThanLost) {
    Bench bench;
    bench.answering = false;
    bench.in.device = HapticState::Homing;
    EXPECT_EQ(bench.run(500).reason, GateReason::DeviceNotReady);
    bench.answering = true;
    bench.in.device = HapticState::Ready;
    EXPECT_EQ(bench.tick().reason, GateReason::Starting);
}

TEST(Law, AResetWhileTheDeviceIsStillAwayBringsNoForce) {
    Bench bench;
    bench.run(2000);
    bench.answering = false;
    bench.run(100);
    ++bench.in.orders.resets;
    const LawOutput out = bench.tick();
    EXPECT_EQ(out.force_n, glm::dvec3(0.0));
    EXPECT_EQ(out.reason, GateReason::DeviceNotReady);
}

TEST(Law, WithoutAnAnswerTheForceIsGone100msAfterItWasDue) {
    Bench bench;
    bench.run(2000);  // the last snapshot arrived 19 ticks ago
    bench.fluid_runs = false;
    const LawOutput held = bench.run(80 - 19);
    EXPECT_EQ(held.fluid_age, Instant(std::chrono::milliseconds(80)));
    EXPECT_NEAR(held.force_n.y, 2.0, 1e-12);
    for (int i = 1; i < 40; ++i) EXPECT_NEAR(bench.tick().force_n.y, 2.0 * (1.0 - i / 40.0), 1e-12);
    const LawOutput gone = bench.tick();
    EXPECT_EQ(gone.fluid_age, Instant(std::chrono::milliseconds(20 + 100)));
    EXPECT_EQ(gone.force_n, glm::dvec3(0.0));
    EXPECT_EQ(gone.reason, GateReason::FluidStale);
}

TEST(Law, AnAnswerThreeOfTheFluidsPeriodsLateIsInTime) {
    Bench bench;
    bench.in.fluid.fluid_period = Seconds(0.050);
    bench.run(2000);  // arrived 49 ticks ago
    bench.fluid_runs = false;
    EXPECT_EQ(bench.run(200 - 49).reason, GateReason::Open);
    EXPECT_EQ(bench.tick().reason, GateReason::FluidStale);
}

TEST(Law, AFastFluidAndAPeriodThatIsNotFiniteAreAllowed50ms) {
    for (const double period : {kNan, std::numeric_limits<double>::infinity(), 0.001}) {
        Bench bench;
        bench.run(2000);
        bench.fluid_runs = false;
        bench.in.fluid.fluid_period = Seconds(period);
        const auto run_to_age = [&](int age_ms) {
            while (bench.in.now - bench.state.fluid_arrived < std::chrono::milliseconds(age_ms)) {
                ++bench.ticks;
                bench.in.now = std::chrono::milliseconds(bench.ticks);
                law(bench.state, bench.in, kNominalTick);
            }
        };
        run_to_age(50);
        EXPECT_EQ(bench.state.gate.reason(), GateReason::Open);
        run_to_age(51);
        EXPECT_EQ(bench.state.gate.reason(), GateReason::FluidStale);
    }
}

TEST(Law, AFluidThatIsLateNowAndThenHasItsForceBackSoon) {
    // A picture of 120 ms twice a second.
    Bench bench;
    double sum_n = 0.0, steepest_n = 0.0, before_n = 2.0;
    for (int ms = 0; ms < 10'000; ++ms) {
        bench.fluid_runs = ms % 500 < 400;
        const double force_n = bench.tick().force_n.y;
        if (ms >= 2000) sum_n += force_n / 8000.0;
        if (ms >= 2000) steepest_n = std::max(steepest_n, force_n - before_n);
        before_n = force_n;
    }
    EXPECT_GT(sum_n, 0.75 * 2.0) << "the mean";
    EXPECT_LT(steepest_n, 1.01 * 2.0 * 0.001 / kQuickReturn.count());
}

TEST(Law, ComesBackByItselfWhenTheFluidDoes) {
    Bench bench;
    bench.run(2000);
    bench.fluid_runs = false;
    glm::dvec3 last = bench.run(250).force_n;
    EXPECT_EQ(last, glm::dvec3(0.0));
    bench.fluid_runs = true;
    for (int i = 0; i < 1200; ++i) {
        const glm::dvec3 force = bench.tick().force_n;
        EXPECT_LE(glm::length(force - last), 0.020);
        last = force;
    }
    EXPECT_NEAR(last.y, 2.0, 1e-12);
}

TEST(Law, AForceThatIsNotFiniteReachesNeitherHandNorFilter) {
    Bench bench;
    bench.run(2000);
    bench.in.fluid.force_n.x = kNan;
    EXPECT_EQ(bench.tick().force_n, glm::dvec3(0.0));
    bench.in.fluid.force_n.x = 0.0;
    EXPECT_EQ(bench.run(100).reason, GateReason::NotFinite);
    ++bench.in.orders.resets;
    EXPECT_NEAR(bench.run(2000).force_n.y, 2.0, 1e-12);
}

TEST(Law, AReadingThatIsNotFiniteLatchesAndNeverReachesTheFluid) {
    for (const double bad : {kNan, std::numeric_limits<double>::max()}) {
        Bench bench;
        bench.run(2000);
        bench.handle_m.x = bad;
        const LawOutput out = bench.tick();
        EXPECT_EQ(out.force_n, glm::dvec3(0.0));
        EXPECT_EQ(out.reason, GateReason::NotFinite);
        EXPECT_EQ(out.pose.position_m, glm::dvec3(0.1));
        EXPECT_EQ(out.pose.velocity_m_s, glm::dvec3(0.0));
    }
}

TEST(Law, AHandleFasterThanAMetreASecondFeelsNoForce) {
    Bench bench;
    bench.run(2000);
    for (int i = 0; i < 30; ++i) {
        bench.handle_m.x += 1.3e-3;
        bench.tick();
    }
    EXPECT_EQ(bench.state.gate.reason(), GateReason::TooFast);
    EXPECT_EQ(bench.run(10).reason, GateReason::Starting);  // the hand has stopped
}

TEST(Law, AHandleThatComesBackElsewhereDoesNotFling) {
    Bench bench;
    bench.run(100);
    bench.in.device = HapticState::Homing;
    bench.answering = false;
    bench.run(10);
    bench.in.device = HapticState::Ready;
    bench.answering = true;
    bench.handle_m = glm::dvec3(0.03);
    EXPECT_EQ(bench.tick().pose.velocity_m_s, glm::dvec3(0.0));
}

TEST(Law, SameInputsGiveTheSameOutputsBitForBit) {
    Bench a, b;
    for (int i = 0; i < 3000; ++i) {
        a.handle_m = b.handle_m = 0.03 * glm::dvec3(std::sin(0.01 * i), std::cos(0.013 * i), 0.0);
        const LawOutput x = a.tick(), y = b.tick();
        ASSERT_EQ(std::memcmp(&x.force_n, &y.force_n, sizeof x.force_n), 0);
        ASSERT_EQ(std::memcmp(&x.pose.velocity_m_s, &y.pose.velocity_m_s, sizeof x.pose.velocity_m_s), 0);
    }
}

}  // namespace
}  // namespace eddy
