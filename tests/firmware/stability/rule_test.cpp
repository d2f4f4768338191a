#include "firmware/stability/rule.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace eddy::stability {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

const Tank kTank{.cells = {4, 3, 2}, .cell_m = 0.1, .density_kg_m3 = 2.0};

Fields still() {
    return {std::vector<glm::vec3>(5 * 4 * 3), std::vector<float>(4 * 3 * 2),
            std::vector<float>(4 * 3 * 2, 0.5f), std::vector<float>(4 * 3 * 2)};
}

/// Everywhere the same velocity.
Fields stream(float speed) {
    Fields fields = still();
    for (glm::vec3& u : fields.velocity_m_s) u.x = speed;
    return fields;
}

StepSeen step_with(const Fields& fields, const Justified& justified = {}) {
    return {.step = 7, .time_s = 0.1, .justified = justified, .fields = &fields};
}

/// What the rule says of a tank that is at rest at the start and then holds these fields.
Verdict verdict_on(const Fields& fields, const Justified& justified = {}) {
    Rule rule(kTank);
    rule.begin(still());
    rule.see(step_with(fields, justified));
    return rule.verdict();
}

TEST(Rule, PassesATankAtRest) {
    const Verdict verdict = verdict_on(still());
    EXPECT_TRUE(verdict.pass) << verdict.reason;
    EXPECT_EQ(verdict.kinetic_energy_ratio, 0.0);
    EXPECT_EQ(verdict.non_finite, 0);
}

TEST(Rule, FindsANumberThatIsNoneInAnyField) {
    const std::vector<std::function<void(Fields&, float)>> places{
        [](Fields& f, float v) { f.velocity_m_s[33].y = v; },
        [](Fields& f, float v) { f.velocity_m_s.back().z = v; },  // beyond the upper walls
        [](Fields& f, float v) { f.pressure_pa[5] = v; }, [](Fields& f, float v) { f.smoke[0] = v; },
        [](Fields& f, float v) { f.temperature_k[23] = v; }};
    for (const auto& place : places)
        for (const float value : {kNan, kInf, -kInf}) {
            Fields fields = still();
            place(fields, value);
            const Verdict verdict = verdict_on(fields);
            EXPECT_FALSE(verdict.pass);
            EXPECT_EQ(verdict.non_finite, 1);
            EXPECT_THAT(verdict.reason, HasSubstr("step 7: 1 texels are not finite"));
        }
}

TEST(Rule, FindsALoadThatIsNotFinite) {
    for (const bool torque : {false, true}) {
        Rule rule(kTank);
        rule.begin(still());
        gles::Load load;
        (torque ? load.torque_nm : load.force_n).y = kNan;
        rule.see({.step = 3, .loads = {{}, load}});
        EXPECT_FALSE(rule.verdict().pass);
        EXPECT_EQ(rule.verdict().reason, "step 3: the load on body 1 is not finite");
    }
}

TEST(Rule, AllowsFiveTimesTheSpeedOfWhatMovesTheFluid) {
    const Justified body{.speed_m_s = 1.0, .work_j = 1e9, .given_j = 1e9};
    EXPECT_TRUE(verdict_on(stream(4.99f), body).pass);
    const Verdict verdict = verdict_on(stream(5.01f), body);
    EXPECT_FALSE(verdict.pass);
    EXPECT_THAT(verdict.reason, HasSubstr("5.01 times as fast as anything"));
    Justified gap = body;
    gap.narrowing = 2.0;
    EXPECT_TRUE(verdict_on(stream(5.01f), gap).pass);
}

TEST(Rule, AllowsWhatTheTankBeganWith) {
    Rule rule(kTank);
    rule.begin(stream(1.0f));
    rule.see(step_with(stream(1.0f)));
    EXPECT_TRUE(rule.verdict().pass) << rule.verdict().reason;
}

TEST(Rule, DoesNotJudgeFacesThatAreNotInTheTank) {
    Fields fields = still();
    fields.velocity_m_s.back() = {3.0f, 3.0f, 3.0f};  // the corner beyond all upper walls
    fields.velocity_m_s[4] = {0.0f, 9.0f, 9.0f};      // x high: only x is a face
    EXPECT_TRUE(verdict_on(fields).pass) << verdict_on(fields).reason;
    fields.velocity_m_s[4].x = 1e-3f;
    EXPECT_FALSE(verdict_on(fields).pass);
}

TEST(Rule, CountsTheEnergyOfAStreamOnce) {
    // 1/2 rho V u^2, V = 0.4 * 0.3 * 0.2 m^3
    EXPECT_NEAR(kinetic_energy_j(kTank, stream(3.0f)), 0.5 * 2.0 * 0.024 * 9.0, 1e-9);
    Tank collocated = kTank;
    collocated.staggered = false;
    Fields centres = still();
    centres.velocity_m_s.assign(24, {0.0f, 3.0f, 0.0f});
    EXPECT_NEAR(kinetic_energy_j(collocated, centres), 0.5 * 2.0 * 0.024 * 9.0, 1e-9);
}

TEST(Rule, AllowsTheEnergyThatWasGivenAndFivePercent) {
    const double joule = kinetic_energy_j(kTank, stream(1.0f));
    const auto given = [&](double share) {
        return Justified{.speed_m_s = 1.0, .work_j = share * joule, .given_j = share * joule};
    };
    EXPECT_TRUE(verdict_on(stream(1.0f), given(0.96)).pass);
    EXPECT_NEAR(verdict_on(stream(1.0f), given(1.0)).kinetic_energy_ratio, 1.0 / 1.05, 1e-6);
    const Verdict verdict = verdict_on(stream(1.0f), given(0.95));
    EXPECT_FALSE(verdict.pass);
    EXPECT_THAT(verdict.reason, HasSubstr("kinetic energy"));
    // What was taken back again is no longer there.
    Justified taken = given(2.0);
    taken.work_j = 0.5 * joule;
    EXPECT_FALSE(verdict_on(stream(1.0f), taken).pass);
}

TEST(Rule, WhatFrictionHasTakenMayNotComeBack) {
    const double joule = kinetic_energy_j(kTank, stream(1.0f));
    // Set going, at rest again after two seconds, and going once more for the same work.
    const auto again = [&](double back_s, const Justified& may, float speed) {
        Rule rule(kTank);
        rule.begin(still());
        const Fields going = stream(1.0f), rest = still(), back = stream(speed);
        for (const auto& [time_s, fields] :
             {std::pair(0.1, &going), std::pair(2.0, &rest), std::pair(back_s, &back)})
            rule.see({.time_s = time_s, .justified = may, .fields = fields});
        return rule.verdict();
    };
    const Justified done{.speed_m_s = 1.0, .work_j = joule, .given_j = joule};
    EXPECT_THAT(again(3.1, done, 1.0f).reason, HasSubstr("kinetic energy"));
    EXPECT_TRUE(again(3.1, done, 0.2f).pass) << "a twenty-fifth of it";
    EXPECT_TRUE(again(2.9, done, 1.0f).pass) << "books of less than a second need not balance";
    Justified ahead = done;
    ahead.ahead_j = joule;
    EXPECT_TRUE(again(3.1, ahead, 1.0f).pass) << "work that may still be done";
}

TEST(Rule, AFaultHasNoBooks) {
    const double joule = kinetic_energy_j(kTank, stream(1.0f));
    const Justified may{.speed_m_s = 1.0, .work_j = joule, .given_j = joule};
    Rule rule(kTank);
    rule.begin(still());
    const Fields going = stream(1.0f), rest = still();
    rule.see({.time_s = 1.0, .justified = may, .fields = &rest});
    rule.see({.time_s = 2.5, .justified = may, .fields = &rest});  // what was at 1 s stands by now
    rule.see({.time_s = 3.0, .justified = may, .fields = &going, .pardoned = true});
    rule.see({.time_s = 3.1, .justified = may, .fields = &going});
    EXPECT_TRUE(rule.verdict().pass);
}

TEST(Rule, WantsSmokeAndHeatBetweenTheirExtremes) {
    Fields smoke = still();
    smoke.smoke[3] = 0.51f;
    EXPECT_THAT(verdict_on(smoke).reason, HasSubstr("smoke from 0.5 to 0.51"));
    EXPECT_TRUE(verdict_on(smoke, {.smoke_added = {0.0, 0.01}}).pass);
    smoke.smoke[3] = -0.01f;
    EXPECT_FALSE(verdict_on(smoke).pass);
    Fields heat = still();
    heat.temperature_k[3] = -1.0f;
    EXPECT_THAT(verdict_on(heat).reason, HasSubstr("temperature from -1"));
    EXPECT_TRUE(verdict_on(heat, {.temperature_added_k = {-1.0, 0.0}}).pass);
}

TEST(Rule, HoldsTheHandsForceToItsLimitAndItsSlew) {
    const auto felt = [](const std::vector<double>& forces_n) {
        Rule rule(kTank, {.most_n = 4.0, .slew_n_per_s = 100.0});
        for (const double f : forces_n) rule.feel({0.0, f, 0.0}, 1e-3);
        return rule.verdict();
    };
    EXPECT_TRUE(felt({0.1, 0.2, 0.15, 0.0}).pass);
    EXPECT_TRUE(felt({0.1, 0.2, 0.3, 0.0}).pass) << "a fault drops the force at once";
    EXPECT_THAT(felt({0.1, 0.3}).reason, HasSubstr("changes by 0.2 N in 1 ms"));
    EXPECT_FALSE(felt({0.1, 0.2, -0.2}).pass) << "through zero and out again is no drop";
    Rule rule(kTank, {.most_n = 4.0, .slew_n_per_s = 1e6});
    rule.feel({0.0, 0.0, 4.01}, 1e-3);
    EXPECT_THAT(rule.verdict().reason, HasSubstr("more than its 4 N"));
    Rule other(kTank);
    other.feel({kNan, 0.0, 0.0}, 1e-3);
    EXPECT_FALSE(other.verdict().pass);
}

/// 0.5 s of force, then calm with what is left of force and speed, for so long.
Verdict calm_with(double force_share, float speed, double calm_s, double viscosity = 0.0) {
    Tank tank = kTank;
    tank.viscosity_pa_s = viscosity;
    Rule rule(tank);
    const Fields moving = stream(1.0f), left = stream(speed);
    rule.begin(moving);
    long step = 0;
    for (double t = 0.1; t < 0.55 + calm_s; t += 0.1) {
        const bool disturbed = t < 0.55;
        rule.see({.step = ++step,
                  .time_s = t,
                  .fields = disturbed ? &moving : &left,
                  .loads = {{{disturbed ? 1.0 : force_share, 0.0, 0.0}, {}}},
                  .disturbed = disturbed});
    }
    return rule.verdict();
}

TEST(Rule, WantsTheForceGoneFiveSecondsAfterTheLastDisturbance) {
    EXPECT_TRUE(calm_with(0.019, 0.1f, 5.2).pass);
    EXPECT_TRUE(calm_with(0.021, 0.1f, 4.8).pass) << "nobody has waited long enough";
    const Verdict verdict = calm_with(0.021, 0.1f, 5.2);
    EXPECT_FALSE(verdict.pass);
    EXPECT_THAT(verdict.reason, HasSubstr("the force is 2.1 % of its peak"));
    EXPECT_FALSE(verdict.recovery_s);
}

TEST(Rule, WantsHalfTheEnergyGoneByFrictionsTime) {
    const double length_m = 0.4, pi = 3.14159265358979;
    const double slow = 2.0 * length_m * length_m / (pi * pi * 6.0);  // 6 s
    const double fast = 2.0 * length_m * length_m / (pi * pi * 1.0);  // 1 s: 5 s count
    EXPECT_TRUE(calm_with(0.0, 0.9f, 5.4, slow).pass);
    EXPECT_FALSE(calm_with(0.0, 0.9f, 6.4, slow).pass);
    EXPECT_FALSE(calm_with(0.0, 0.9f, 5.4, fast).pass);
    EXPECT_TRUE(calm_with(0.0, 0.9f, 9.0, 0.0).pass) << "without friction nothing slows it";
}

TEST(Rule, SaysWhenItWasCalm) {
    Rule rule(kTank);
    const Fields moving = stream(1.0f), slow = stream(0.5f);
    rule.begin(moving);
    rule.see({.step = 1, .time_s = 1.0, .fields = &moving, .loads = {{{1.0, 0.0, 0.0}, {}}}});
    rule.see(
        {.step = 2, .time_s = 2.0, .fields = &moving, .loads = {{{0.5, 0.0, 0.0}, {}}}, .disturbed = false});
    rule.see(
        {.step = 3, .time_s = 3.0, .fields = &moving, .loads = {{{0.0, 0.0, 0.0}, {}}}, .disturbed = false});
    EXPECT_FALSE(rule.verdict().recovery_s);
    rule.see(
        {.step = 4, .time_s = 4.0, .fields = &slow, .loads = {{{0.0, 0.0, 0.0}, {}}}, .disturbed = false});
    ASSERT_TRUE(rule.verdict().recovery_s);
    EXPECT_DOUBLE_EQ(*rule.verdict().recovery_s, 3.0) << "from the end of the last step that disturbed";
}

TEST(Rule, CountsAPardonedFaultButDoesNotJudgeIt) {
    Fields broken = still();
    broken.pressure_pa[1] = kInf;
    StepSeen step = step_with(broken);
    step.pardoned = true;
    Rule rule(kTank);
    rule.begin(still());
    rule.see(step);
    EXPECT_TRUE(rule.verdict().pass);
    EXPECT_EQ(rule.verdict().non_finite, 1);
    step.pardoned = false;
    rule.see(step);
    EXPECT_FALSE(rule.verdict().pass);
}

TEST(Rule, KeepsTheFirstReason) {
    Rule rule(kTank);
    rule.begin(still());
    rule.blame(2, "too hot");
    rule.blame(3, "too cold");
    EXPECT_EQ(rule.verdict().reason, "step 2: too hot");
}

}  // namespace
}  // namespace eddy::stability
