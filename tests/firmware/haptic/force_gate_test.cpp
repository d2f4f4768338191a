#include "firmware/haptic/force_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "firmware/haptic/law.h"
#include "firmware/haptic/vector.h"

namespace eddy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

GateInput wanted(const glm::dvec3& force_n) {
    return {.force_n = force_n, .enabled = true, .device_ready = true, .fluid_stale = false};
}

glm::dvec3 repeat(ForceGate& gate, const GateInput& in, int ticks) {
    glm::dvec3 force(0.0);
    for (int i = 0; i < ticks; ++i) force = gate(in, kNominalTick);
    return force;
}

/// A gate that has been open for two seconds with `force_n` on it.
ForceGate opened(const glm::dvec3& force_n, const GateLimits& limits = {}) {
    ForceGate gate(limits);
    repeat(gate, wanted(force_n), 2000);
    return gate;
}

TEST(ForceGate, PassesAForceWithinItsLimitsUnchanged) {
    ForceGate gate = opened(glm::dvec3(1.0, -2.0, 3.0));
    EXPECT_EQ(gate(wanted(glm::dvec3(1.0, -2.0, 3.0)), kNominalTick), glm::dvec3(1.0, -2.0, 3.0));
    EXPECT_EQ(gate.reason(), GateReason::Open);
    EXPECT_EQ(gate.counters().clamped, 0U);
}

TEST(ForceGate, ClampsTheLengthAndKeepsTheDirection) {
    ForceGate gate = opened(glm::dvec3(30.0, 0.0, 40.0), {.max_force_n = 5.0});
    const glm::dvec3 force = gate(wanted(glm::dvec3(30.0, 0.0, 40.0)), kNominalTick);
    EXPECT_NEAR(glm::length(force - glm::dvec3(3.0, 0.0, 4.0)), 0.0, 1e-14);
    EXPECT_EQ(gate.counters().clamped, 2001U);
}

TEST(ForceGate, NoSettingRaisesTheForceAboveTheDevices) {
    ForceGate gate = opened(glm::dvec3(100.0, 0.0, 0.0), {.max_force_n = 50.0});
    EXPECT_DOUBLE_EQ(glm::length(gate(wanted(glm::dvec3(100.0, 0.0, 0.0)), kNominalTick)), kDeviceMaxForceN);
}

TEST(ForceGate, ALimitThatIsNotANumberShutsIt) {
    for (const GateLimits& bad : {GateLimits{.max_force_n = kNan}, GateLimits{.max_force_n = -1.0},
                                  GateLimits{.slew_n_per_s = kNan}, GateLimits{.slew_n_per_s = -1.0}}) {
        ForceGate gate = opened(glm::dvec3(3.0, 0.0, 0.0), bad);
        EXPECT_EQ(gate(wanted(glm::dvec3(3.0, 0.0, 0.0)), kNominalTick), glm::dvec3(0.0));
    }
}

TEST(ForceGate, FollowsALowerCeilingWithinTheSlewLimitAndNeverAHigherOneThanItsOwn) {
    ForceGate gate = opened(glm::dvec3(0.0, 6.0, 0.0), {.max_force_n = 4.0, .slew_n_per_s = 100.0});
    GateInput in = wanted(glm::dvec3(0.0, 6.0, 0.0));
    in.most_n = 3.0;
    EXPECT_NEAR(gate(in, kNominalTick).y, 3.9, 1e-12);
    EXPECT_NEAR(repeat(gate, in, 9).y, 3.0, 1e-12);
    in.most_n = 7.0;
    EXPECT_NEAR(repeat(gate, in, 100).y, 4.0, 1e-12);
    for (const double bad : {kNan, -1.0}) {
        in.most_n = bad;
        EXPECT_NEAR(repeat(gate, in, 100).y, 0.0, 1e-12);
    }
}

TEST(ForceGate, SlewsToANewForceAtTheLimit) {
    ForceGate gate = opened(glm::dvec3(0.0), {.slew_n_per_s = 100.0});
    for (int i = 1; i <= 40; ++i)
        EXPECT_NEAR(gate(wanted(glm::dvec3(0.0, 4.0, 0.0)), kNominalTick).y, 0.1 * i, 1e-12);
    EXPECT_NEAR(gate(wanted(glm::dvec3(0.0, 4.0, 0.0)), kNominalTick).y, 4.0, 1e-12);
    EXPECT_NEAR(static_cast<double>(gate.counters().slewed), 39.5,
                0.6);  // the last step may round either way
}

TEST(ForceGate, ALateTickDoesNotSpendTheWholeGapInOneStep) {
    ForceGate gate = opened(glm::dvec3(0.0), {.slew_n_per_s = 100.0});
    EXPECT_NEAR(gate(wanted(glm::dvec3(8.0, 0.0, 0.0)), Seconds(0.5)).x, 100.0 * kLongestRise.count(), 1e-12);
}

TEST(ForceGate, StartsSoftlyOverOneSecond) {
    ForceGate gate;
    for (int i = 1; i <= 1000; ++i)
        EXPECT_NEAR(gate(wanted(glm::dvec3(0.0, 0.0, 8.0)), kNominalTick).z, 8.0 * i / 1000.0, 1e-9);
    EXPECT_NEAR(gate(wanted(glm::dvec3(0.0, 0.0, 8.0)), kNominalTick).z, 8.0, 1e-9);
}

TEST(ForceGate, EachFaultZeroesTheForceInOneTickAndReturnsSoftly) {
    const glm::dvec3 force(0.0, 8.0, 0.0);
    struct Fault {
        GateReason reason;
        void (*happen)(GateInput&);
    };
    for (const auto& [reason, happen] :
         {Fault{GateReason::Disabled, [](GateInput& in) { in.enabled = false; }},
          Fault{GateReason::DeviceNotReady, [](GateInput& in) { in.device_ready = false; }},
          Fault{GateReason::TooFast, [](GateInput& in) { in.speed_m_s = 1.01; }}}) {
        ForceGate gate = opened(force);
        // A hiccup of the fluid before it makes no difference.
        GateInput late = wanted(force);
        late.fluid_stale = true;
        repeat(gate, late, 50);
        repeat(gate, wanted(force), 20);
        GateInput in = wanted(force);
        happen(in);
        EXPECT_EQ(gate(in, kNominalTick), glm::dvec3(0.0)) << to_string(reason);
        EXPECT_EQ(gate.reason(), reason);
        EXPECT_NEAR(gate(wanted(force), kNominalTick).y, 0.008, 1e-12) << to_string(reason);
        EXPECT_EQ(gate.reason(), GateReason::Starting);
    }
}

TEST(ForceGate, ADeviceThatIsUnsureForAMomentGetsZeroAndTheForceBackQuickly) {
    const glm::dvec3 force(0.0, 4.0, 0.0);
    ForceGate gate = opened(force);
    GateInput unsure = wanted(force);
    unsure.device_unsure = true;
    EXPECT_EQ(gate(unsure, kNominalTick), glm::dvec3(0.0)) << "it has no force anyway";
    EXPECT_EQ(gate.reason(), GateReason::DeviceUnsure);
    repeat(gate, unsure, 90);
    EXPECT_NEAR(gate(wanted(force), kNominalTick).y, 4.0 / 150.0, 1e-12);
    EXPECT_NEAR(repeat(gate, wanted(force), 150).y, 4.0, 1e-9);
    // For longer, it is as any fault.
    repeat(gate, unsure, 101);
    EXPECT_NEAR(gate(wanted(force), kNominalTick).y, 4.0 / 1000.0, 1e-12);
}

TEST(ForceGate, ANumberThatIsNotFiniteBecomesZeroAndLatchesUntilReset) {
    const glm::dvec3 force(0.0, 8.0, 0.0);
    for (const double bad : {kNan, kInf, -kInf}) {
        ForceGate gate = opened(force);
        EXPECT_EQ(gate(wanted(glm::dvec3(0.0, 0.0, bad)), kNominalTick), glm::dvec3(0.0));
        EXPECT_EQ(repeat(gate, wanted(force), 5000), glm::dvec3(0.0));
        EXPECT_EQ(gate.reason(), GateReason::NotFinite);
        EXPECT_EQ(gate.counters().non_finite, 1U);

        GateInput reset = wanted(force);
        reset.reset = true;
        EXPECT_NEAR(gate(reset, kNominalTick).y, 0.008, 1e-12);
    }
}

TEST(ForceGate, ASpeedThatIsNotFiniteLatchesToo) {
    ForceGate gate = opened(glm::dvec3(1.0));
    GateInput in = wanted(glm::dvec3(1.0));
    in.speed_m_s = kNan;
    EXPECT_EQ(gate(in, kNominalTick), glm::dvec3(0.0));
    EXPECT_EQ(repeat(gate, wanted(glm::dvec3(1.0)), 100), glm::dvec3(0.0));
}

TEST(ForceGate, ASilentDeviceLatchesUntilResetAndAgainIfStillSilent) {
    ForceGate gate = opened(glm::dvec3(1.0));
    GateInput silent = wanted(glm::dvec3(1.0));
    silent.device_silent = true;
    EXPECT_EQ(gate(silent, kNominalTick), glm::dvec3(0.0));
    EXPECT_EQ(repeat(gate, wanted(glm::dvec3(1.0)), 100), glm::dvec3(0.0));
    EXPECT_EQ(gate.reason(), GateReason::DeviceSilent);

    silent.reset = true;
    EXPECT_EQ(gate(silent, kNominalTick), glm::dvec3(0.0));
    EXPECT_EQ(repeat(gate, wanted(glm::dvec3(1.0)), 100), glm::dvec3(0.0));
}

TEST(ForceGate, FadesAStaleForceToZeroIn40msHoweverSlowTheSlew) {
    for (const double slew : {100.0, 10.0}) {
        ForceGate gate = opened(glm::dvec3(0.0, 8.0, 0.0), {.slew_n_per_s = slew});
        GateInput stale = wanted(glm::dvec3(5.0, 5.0, 5.0));  // nobody believes this one
        stale.fluid_stale = true;
        for (int i = 1; i < 40; ++i) {
            const glm::dvec3 force = gate(stale, kNominalTick);
            EXPECT_NEAR(glm::length(force - glm::dvec3(0.0, 8.0 * (1.0 - i / 40.0), 0.0)), 0.0, 1e-12);
            EXPECT_NE(force.y, 0.0);
        }
        EXPECT_EQ(gate(stale, kNominalTick), glm::dvec3(0.0));
        EXPECT_EQ(gate.reason(), GateReason::FluidStale);
    }
}

TEST(ForceGate, TheFadeTakesAsLongForAnyTickLength) {
    for (const int ticks : {1, 25, 100, 400}) {
        ForceGate gate = opened(glm::dvec3(0.0, 8.0, 0.0));
        GateInput stale = wanted(glm::dvec3(0.0, 8.0, 0.0));
        stale.fluid_stale = true;
        for (int i = 1; i < ticks; ++i) EXPECT_GT(gate(stale, kFade / ticks).y, 0.0);
        EXPECT_EQ(gate(stale, kFade / ticks), glm::dvec3(0.0)) << ticks;
    }
}

TEST(ForceGate, ComesBackFromAStallAtNoMoreThan20MillinewtonsATick) {
    ForceGate gate = opened(glm::dvec3(0.0, 8.0, 0.0));
    GateInput stale = wanted(glm::dvec3(0.0, 8.0, 0.0));
    stale.fluid_stale = true;
    glm::dvec3 last = repeat(gate, stale, 150);
    for (int i = 0; i < 1100; ++i) {
        const glm::dvec3 force = gate(wanted(glm::dvec3(0.0, 8.0, 0.0)), kNominalTick);
        EXPECT_LE(glm::length(force - last), 0.020);
        last = force;
    }
    EXPECT_NEAR(last.y, 8.0, 1e-12);
}

/// Numbers a broken solver, device or clock might hand over, and ordinary ones.
class Chaos {
  public:
    double number() {
        switch (pick(16)) {
            case 0:
                return 0.0;
            case 1:
                return -0.0;
            case 2:
                return std::numeric_limits<double>::denorm_min() * sign();
            case 3:
                return std::numeric_limits<double>::max() * sign();
            case 4:
                return 1e200 * sign();
            case 5:
                return 1e-310 * sign();
            default:
                return normal_(random_);
        }
    }
    double rare(double value, int odds) { return pick(odds) == 0 ? value : number(); }
    bool one_in(int odds) { return pick(odds) == 0; }
    Seconds dt() {
        switch (pick(40)) {
            case 0:
                return Seconds(0.0);
            case 1:
                return Seconds(-0.001);
            case 2:
                return Seconds(kNan);
            case 3:
                return Seconds(kInf);
            case 4:
                return Seconds(0.25);
            case 5:
                return Seconds(std::numeric_limits<double>::denorm_min());
            default:
                return Seconds(0.001 * std::exp(0.3 * normal_(random_) / 4.0));
        }
    }

  private:
    int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    double sign() { return pick(2) == 0 ? 1.0 : -1.0; }
    std::mt19937_64 random_{20090318};
    std::normal_distribution<double> normal_{0.0, 4.0};
};

TEST(ForceGate, KeepsItsPromisesForAMillionInputsOfAnyKind) {
    const GateLimits limits{.max_force_n = 6.0, .slew_n_per_s = 80.0};
    ForceGate gate(limits);
    Chaos chaos;
    glm::dvec3 last(0.0);
    bool latched = false;
    int open = 0, fading = 0, latches = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const double bad = std::array{kNan, kInf, -kInf}[static_cast<std::size_t>(i % 3)];
        const GateInput in{.force_n = {chaos.rare(bad, 9000), chaos.rare(bad, 9000), chaos.number()},
                           .speed_m_s = chaos.one_in(3000)  ? bad
                                        : chaos.one_in(400) ? 1.5
                                                            : 0.2,
                           .enabled = !chaos.one_in(300),
                           .device_ready = !chaos.one_in(300),
                           .device_silent = chaos.one_in(3000),
                           .fluid_stale = chaos.one_in(10),
                           .reset = chaos.one_in(100)};
        const Seconds dt = chaos.dt();
        const glm::dvec3 force = gate(in, dt);

        ASSERT_TRUE(is_finite(force)) << i;
        ASSERT_LE(glm::length(force), limits.max_force_n * (1.0 + 1e-15)) << i;

        const bool broken = !is_finite(in.force_n) || !std::isfinite(in.speed_m_s) || in.device_silent;
        latched = broken || (latched && !in.reset);
        latches += broken;
        const bool zero = latched || !in.enabled || !in.device_ready || in.speed_m_s > kFastestHandMS;
        if (zero) {
            ASSERT_EQ(force, glm::dvec3(0.0)) << i;
        } else if (in.fluid_stale) {
            ASSERT_LE(glm::length(force), glm::length(last)) << i;
            fading += force != last;
        } else {
            const double time = dt.count() > 0.0 ? std::min(dt.count(), 1.0) : 0.0;
            // 8 roundings of a force of at most 6 N
            ASSERT_LE(glm::length(force - last), limits.slew_n_per_s * time + 8 * 6.0 * 1.1e-16) << i;
            open += force != glm::dvec3(0.0);
        }
        last = force;
    }
    // The chaos must not have kept the gate shut.
    EXPECT_GT(open, 300'000);
    EXPECT_GT(fading, 10'000);
    EXPECT_GT(latches, 500);
}

TEST(GateReason, HasItsOwnSentenceInTheTable) {
    for (std::size_t i = 0; i < kGateSentences.size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(kGateSentences[i].reason), i);
        EXPECT_EQ(to_string(kGateSentences[i].reason), kGateSentences[i].sentence);
    }
}

}  // namespace
}  // namespace eddy
