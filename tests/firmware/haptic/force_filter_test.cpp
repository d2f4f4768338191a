#include "firmware/haptic/force_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "firmware/haptic/law.h"

namespace eddy {
namespace {

constexpr Seconds kPeriod50{0.020};                             // fluid at 50 Hz: cut-off 12.5 Hz
constexpr double kTau = 1.0 / (2.0 * std::numbers::pi * 12.5);  // [s]
const ForceFilterSettings kNoImpulseLimit{.impulse_n = 1e6};

/// Amplitude of the line at `hz` in samples a tick apart that span whole periods of it.
double line(const std::vector<double>& samples, double hz) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i)
        sum += samples[i] * std::polar(1.0, -2.0 * std::numbers::pi * hz * static_cast<double>(i) * 1e-3);
    return 2.0 * std::abs(sum) / static_cast<double>(samples.size());
}

/// One second of the filter's answer to `force`, after one second to settle.
template <class Force>
std::vector<double> settled(Force force, Seconds fluid_period) {
    ForceFilter filter(kNoImpulseLimit);
    std::vector<double> samples;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 y = filter(glm::dvec3(force(i), 0.0, 0.0), fluid_period, kNominalTick);
        if (i >= 1000) samples.push_back(y.x);
    }
    return samples;
}

TEST(ForceFilter, StepResponseIsTheExactExponential) {
    ForceFilter filter(kNoImpulseLimit);
    for (int i = 1; i <= 100; ++i) {
        const glm::dvec3 y = filter(glm::dvec3(4.0, -2.0, 0.0), kPeriod50, kNominalTick);
        const double exact = 1.0 - std::exp(-1e-3 * i / kTau);
        EXPECT_NEAR(y.x, 4.0 * exact, 1e-13);
        EXPECT_NEAR(y.y, -2.0 * exact, 1e-13);
        EXPECT_EQ(y.z, 0.0);
    }
}

TEST(ForceFilter, DoesNotCareHowTimeIsCutIntoTicks) {
    ForceFilter even(kNoImpulseLimit), uneven(kNoImpulseLimit);
    const glm::dvec3 step(1.0, 2.0, 3.0);
    for (int i = 0; i < 10; ++i) even(step, kPeriod50, kNominalTick);
    for (const double ms : {0.1, 3.7, 0.0, 1.2, 4.0}) uneven(step, kPeriod50, Seconds(ms * 1e-3));
    const glm::dvec3 a = even(step, kPeriod50, kNominalTick), b = uneven(step, kPeriod50, Seconds(0.002));
    EXPECT_NEAR(glm::length(a - b), 0.0, 1e-14);
}

TEST(ForceFilter, IsThreeDecibelsDownAtAQuarterOfTheFluidRate) {
    for (const int rate_hz : {20, 40, 80}) {  // a whole number of periods of rate/4 fits the second measured
        const double cutoff = rate_hz / 4.0;
        const double theta = 2.0 * std::numbers::pi * cutoff * 1e-3;
        const double w = 1.0 - std::exp(-theta);
        const double exact = w / std::abs(1.0 - (1.0 - w) * std::polar(1.0, -theta));
        const auto sine = [&](int i) { return std::sin(theta * i); };
        const double gain = line(settled(sine, Seconds(1.0 / rate_hz)), cutoff);
        EXPECT_NEAR(gain, exact, 1e-9) << rate_hz;
        EXPECT_NEAR(gain, std::numbers::sqrt2 / 2.0, 0.002) << rate_hz;  // sampling costs 0.05 to 0.13 %
    }
}

// A force of 1 Hz held between fluid updates has images at rate -+ 1 Hz of sinc(1/rate -+ 1); a first-order
// low-pass at a quarter of the rate leaves 1.33, 0.50 and 0.25 % of the force there at 20, 50 and 100 Hz.
TEST(ForceFilter, LeavesTheRippleThatTheoryPredictsFromAHeldForce) {
    struct Row {
        int ticks_held;
        double residual;
    };
    for (const auto& [held, residual] : {Row{50, 0.0133}, Row{20, 0.0050}, Row{10, 0.0025}}) {
        const double rate = 1000.0 / held;
        const auto hold = [held = held](int i) {
            return std::sin(2.0 * std::numbers::pi * 1e-3 * (i / held) * held);
        };
        const double image = line(settled(hold, Seconds(1.0 / rate)), rate - 1.0);
        EXPECT_NEAR(image, residual, 0.08 * residual)
            << rate << " Hz";  // 6 % is the sampling at 1 kHz, at 100 Hz
    }
}

TEST(ForceFilter, CutOffFollowsTheFluidWithinItsBand) {
    const ForceFilter filter;
    EXPECT_DOUBLE_EQ(filter.cutoff_hz(Seconds(0.050)), 5.0);
    EXPECT_DOUBLE_EQ(filter.cutoff_hz(Seconds(0.020)), 12.5);
    EXPECT_DOUBLE_EQ(filter.cutoff_hz(Seconds(1.0)), 2.0);
    EXPECT_DOUBLE_EQ(filter.cutoff_hz(Seconds(1e-4)), 50.0);
    for (const double unknown : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_DOUBLE_EQ(filter.cutoff_hz(Seconds(unknown)), 2.0);
}

TEST(ForceFilter, ChangingTheBandwidthMakesNoJump) {
    ForceFilter filter(kNoImpulseLimit);
    glm::dvec3 before(0.0);
    for (int i = 0; i < 1000; ++i) before = filter(glm::dvec3(5.0, 0.0, 0.0), kPeriod50, kNominalTick);
    EXPECT_NEAR(glm::length(filter(glm::dvec3(5.0, 0.0, 0.0), Seconds(0.005), kNominalTick) - before), 0.0,
                1e-12);
}

TEST(ForceFilter, LimitsAnImpulseAndKeepsItsDirection) {
    ForceFilter filter({.impulse_n = 1.0});
    const double w = 1.0 - std::exp(-1e-3 / kTau);
    const glm::dvec3 y = filter(glm::dvec3(300.0, 0.0, -400.0), kPeriod50, kNominalTick);
    EXPECT_NEAR(glm::length(y - w * glm::dvec3(0.6, 0.0, -0.8)), 0.0, 1e-15);
    EXPECT_EQ(filter.impulses(), 1U);
}

TEST(ForceFilter, LeavesAForceBelowTheImpulseThresholdAlone) {
    ForceFilter limited({.impulse_n = 1.0}), linear(kNoImpulseLimit);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 raw(0.3 * std::sin(0.01 * i), 0.3, 0.0);
        EXPECT_EQ(limited(raw, kPeriod50, kNominalTick), linear(raw, kPeriod50, kNominalTick));
    }
    EXPECT_EQ(limited.impulses(), 0U);
}

TEST(ForceFilter, HandsOnANumberThatIsNotFiniteButDoesNotKeepIt) {
    ForceFilter filter;
    const glm::dvec3 nan(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
    EXPECT_TRUE(std::isnan(filter(nan, kPeriod50, kNominalTick).y));
    EXPECT_EQ(filter(glm::dvec3(0.0), kPeriod50, kNominalTick), glm::dvec3(0.0));
}

}  // namespace
}  // namespace eddy
