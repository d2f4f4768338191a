#include "firmware/stability/trial.h"
#include "firmware/stability/transport_watch.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/gles/gl_fixture.h"

namespace eddy::stability {
namespace {

using testing::HasSubstr;

constexpr Trial kSmall{glm::ivec3(8), Effort::Least};

class TrialTest : public gles::GlTest {
  protected:
    Outcome outcome_of(const Case& one, long steps = 20) {
        const Case* cases[] = {&one};
        return try_out(gpu, cases, kSmall, steps);
    }
};

TEST_F(TrialTest, StirringIsNotHard) {
    for (const Drive drive : {Drive::Steps, Drive::Hand}) {
        const Outcome outcome = outcome_of({.name = "stir", .drive = drive});
        EXPECT_TRUE(outcome.verdict.pass) << outcome.verdict.reason;
        EXPECT_EQ(outcome.steps, 20);
        EXPECT_GT(outcome.verdict.largest_force_n, 0.0);
        EXPECT_GT(outcome.verdict.kinetic_energy_ratio, 0.01) << "nothing moved";
    }
}

TEST_F(TrialTest, FindsEnergyThatComesFromNowhere) {
    // A wind that nobody has made.
    const Outcome outcome = outcome_of({.name = "wind", .drive = Drive::Steps, .script = [](Moment& m) {
                                            if (m.step == 5)
                                                m.flow = [](std::vector<glm::vec3>& u) {
                                                    for (std::size_t i = 0; i < u.size(); ++i)
                                                        u[i].y += i / 81 % 2 == 0 ? 30.0f : -30.0f;
                                                };
                                        }});
    EXPECT_FALSE(outcome.verdict.pass);
    EXPECT_THAT(outcome.verdict.reason, HasSubstr("step 6: the fluid moves at"));
    EXPECT_EQ(outcome.steps, 20) << "what is red shows how far it goes";
}

TEST_F(TrialTest, WhatDisturbsStopsAndThenTheFluidCalmsDown) {
    const auto with_calm = [](double calm_s) {
        return Case{.name = "stop",
                    .drive = Drive::Steps,
                    .change =
                        [](Scene& s) {
                            s.tank.walls.x_low = {WallKind::Inflow, {{0.2, 0.0, 0.0}}};
                            s.tank.walls.x_high = {WallKind::Open, {}};
                            Scene::Source& jet = s.sources.emplace_back();
                            jet.name = "jet";
                            jet.centre_m = 0.3 * s.tank.size_m;
                            jet.velocity_m_s = glm::dvec3(0.5, 0.0, 0.0);
                            s.bodies[0].motion = BodyMotion::Prescribed;
                            s.bodies[0].oscillation = {.amplitude_m = {0.02, 0.0, 0.0}, .frequency_hz = 1.0};
                            s.fluid.viscosity_pa_s = 1e-3 * s.fluid.density_kg_m3;
                        },
                    .complaint = [](const History& h) -> std::optional<std::string> {
                        if (h.steps.size() == 20 && h.steps.back().disturbed) return {};
                        return "judged at another time";
                    },
                    .steps = 20,
                    .calm_share = 0.0,
                    .calm_s = calm_s};
    };
    const Outcome outcome = outcome_of(with_calm(5.0));
    EXPECT_TRUE(outcome.verdict.pass) << outcome.verdict.reason;
    EXPECT_EQ(outcome.steps, 20 + 10 + 250);
    EXPECT_TRUE(outcome.verdict.recovery_s);
    EXPECT_EQ(outcome_of(with_calm(5.0), 10).steps, 10) << "cut short it has no calm";
    EXPECT_FALSE(outcome_of(with_calm(0.0)).verdict.recovery_s);
}

TEST_F(TrialTest, FindsSmokeThatComesFromNowhere) {
    const Outcome outcome = outcome_of({.name = "spill",
                                        .script =
                                            [](Moment& m) {
                                                if (m.step == 5) m.faults = {{Fault::Place::Smoke, 7.0f}};
                                            },
                                        .puts_faults = true});
    EXPECT_THAT(outcome.verdict.reason, HasSubstr("smoke from"));
}

TEST_F(TrialTest, FaultsReachTheFieldsTheyAreMeantFor) {
    using Place = Fault::Place;
    gles::FluidSetup setup;
    setup.cells = glm::ivec3(8);
    setup.smoke.emplace();
    setup.bodies = {gles::BodySetup{gles::Sphere{0.008}}};
    for (const Place place : {Place::Velocity, Place::Pressure, Place::Smoke, Place::Fractions}) {
        const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
        Faults faults(gpu);
        faults.begin_step(*fluid);
        fluid->step(0.02, {{.centre_m = glm::dvec3(0.02)}}, false);
        fluid->wait_result();
        EXPECT_EQ(non_finite_texels(download(*fluid)), 0);
        faults.put(*fluid, {place, std::numeric_limits<float>::quiet_NaN()});
        // Of the shares of the solid nothing is downloaded; a texel of the pressure is four cells.
        const long found = place == Place::Fractions ? 0 : place == Place::Pressure ? 4 : 1;
        EXPECT_EQ(non_finite_texels(download(*fluid)), found) << static_cast<int>(place);
    }
}

TEST_F(TrialTest, AFaultInThePressureOfAThickFluidWithAFreeBodyIsOne) {
    gles::FluidSetup setup;
    setup.cells = glm::ivec3(8);
    setup.viscosity_pa_s = 1.0;
    setup.bodies = {gles::BodySetup{.shape = gles::Sphere{0.008}, .coupled = gles::Coupled{}}};
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    Faults faults(gpu);
    faults.begin_step(*fluid);
    fluid->step(0.02, {{.centre_m = glm::dvec3(0.02)}}, false);
    fluid->wait_result();
    faults.put(*fluid, {Fault::Place::Pressure, std::numeric_limits<float>::quiet_NaN()});
    EXPECT_EQ(non_finite_texels(download(*fluid)), 4) << "a texel of the pressure is four cells";
}

TEST_F(TrialTest, AFaultThatMissesIsAnError) {
    gles::FluidSetup setup;
    setup.cells = glm::ivec3(8);
    setup.bodies = {gles::BodySetup{gles::Sphere{0.008}}};
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    Faults faults(gpu);
    const auto strike = [&](Fault::Place place) { faults.put(*fluid, {place, 1e30f}); };
    EXPECT_NO_THROW(strike(Fault::Place::Smoke)) << "there is none";
    EXPECT_THROW(strike(Fault::Place::Fractions), std::logic_error) << "no step has drawn them";
    faults.begin_step(*fluid);
    fluid->step(0.02, {{.centre_m = glm::dvec3(0.02)}}, false);
    EXPECT_NO_THROW(strike(Fault::Place::Fractions));
    faults.begin_step(*fluid);
    fluid->step(0.0, {{.centre_m = glm::dvec3(0.02)}}, false);
    EXPECT_NO_THROW(strike(Fault::Place::Fractions)) << "a step that is refused leaves them";
}

/// In the fifth of 20 steps the clock says something else.
Case clock_says(double dt_s) {
    return {.name = "clock", .drive = Drive::Steps, .script = [dt_s](Moment& m) {
                if (m.step == 5) m.dt_s = dt_s;
            }};
}

TEST_F(TrialTest, AfterAStepThatIsRefusedBodiesMoveOn) {
    Case one = clock_says(std::numeric_limits<double>::quiet_NaN());
    one.change = [](Scene& s) {
        s.bodies[0].motion = BodyMotion::Prescribed;
        s.bodies[0].oscillation = Scene::Oscillation{.amplitude_m = {0.02, 0.0, 0.0}, .frequency_hz = 1.0};
    };
    double last_x = 0.0, before_x = 0.0;
    one.complaint = [&](const History& history) -> std::optional<std::string> {
        last_x = history.steps[19].bodies[0].centre_m.x;
        before_x = history.steps[18].bodies[0].centre_m.x;
        return {};
    };
    EXPECT_TRUE(outcome_of(one).verdict.pass);
    EXPECT_GT(std::abs(last_x - before_x), 1e-4);
    // 19 steps of 20 ms have passed.
    EXPECT_NEAR(last_x, 0.08 + 0.02 * std::sin(2.0 * std::numbers::pi * 0.38), 1e-9);
}

TEST_F(TrialTest, AcrossAStepThatIsRefusedTheHandsBodyIsAsFastAsItGoes) {
    for (const double dt_s : {std::numeric_limits<double>::quiet_NaN(), 900.0}) {
        Case one = clock_says(dt_s);
        long moved = 0;
        one.complaint = [&](const History& history) -> std::optional<std::string> {
            for (std::size_t n = 1; n < history.steps.size(); ++n) {
                const History::Step &before = history.steps[n - 1], &now = history.steps[n];
                const glm::dvec3 way = now.bodies[0].centre_m - before.bodies[0].centre_m;
                EXPECT_LT(glm::length(way - now.dt_s * now.bodies[0].velocity_m_s), 1e-9) << n;
                moved += glm::length(way) > 1e-4;
            }
            return {};
        };
        outcome_of(one);
        EXPECT_GT(moved, 4);
    }
}

TEST_F(TrialTest, OnlyTimeThatTheFluidTookPasses) {
    const auto lasts_s = [&](double dt_s) {
        Case one = clock_says(dt_s);
        double time_s = 0.0;
        one.complaint = [&](const History& history) -> std::optional<std::string> {
            time_s = history.steps.back().time_s;
            return {};
        };
        EXPECT_TRUE(outcome_of(one).verdict.pass);
        return time_s;
    };
    EXPECT_NEAR(lasts_s(0.02), 0.40, 1e-9);
    EXPECT_NEAR(lasts_s(-0.02), 0.38, 1e-9);
    EXPECT_NEAR(lasts_s(std::numeric_limits<double>::infinity()), 0.38, 1e-9);
    EXPECT_NEAR(lasts_s(900.0), 0.48, 1e-9) << "the longest step of the fluid is 0.1 s";
}

TEST_F(TrialTest, TimeThatTheFluidDidNotTakeJustifiesNothing) {
    // In 900 s the source would have made smoke of 9; this comes from a fault.
    Case one = clock_says(900.0);
    one.change = [](Scene& s) {
        Scene::Source& source = s.sources.emplace_back();
        source.name = "source";
        source.centre_m = 0.3 * s.tank.size_m;
        source.radius_m = 0.02;
        source.smoke_per_s = 0.01;
    };
    one.script = [clock = one.script](Moment& m) {
        clock(m);
        if (m.step == 10) m.faults = {{Fault::Place::Smoke, 7.0f}};
    };
    one.puts_faults = true;
    EXPECT_THAT(outcome_of(one).verdict.reason, HasSubstr("smoke from"));
}

TEST_F(TrialTest, SaysWhatItWasTooShortFor) {
    Case one{
        .name = "slow", .remark = [](const History&) { return std::string("a figure"); }, .least_steps = 21};
    EXPECT_EQ(outcome_of(one).remark, "a figure; not judged: all of slow, which takes 21 steps");
    EXPECT_EQ(outcome_of(one, 21).remark, "a figure");
}

TEST_F(TrialTest, AskedForACriterionItSaysWhatIsWrong) {
    const Outcome outcome =
        outcome_of({.name = "picky", .complaint = [](const History& history) {
                        return std::optional("I have seen " + std::to_string(history.steps.size()));
                    }});
    EXPECT_EQ(outcome.verdict.reason, "step 20: I have seen 20");
}

TEST_F(TrialTest, ACaseMaySayAFigureOfItsOwn) {
    const Outcome outcome = outcome_of(
        {.name = "curious",
         .measure =
             [](gles::Gpu&, const gles::Fluid& fluid, const Fields& fields, double time_s) {
                 return time_s * static_cast<double>(fields.pressure_pa.size()) * fluid.setup().cell_m;
             },
         .remark =
             [](const History& history) { return fmt::format("{:.4f}", history.looks.back().measured); }});
    EXPECT_EQ(outcome.remark, fmt::format("{:.4f}", 20 * 0.02 * 512 * 0.02));
}

TEST_F(TrialTest, ACaseMayCompareItselfWithTheCommonScene) {
    std::size_t compared = 0;
    double apart = -1.0;
    outcome_of({.name = "twin",
                .complaint = [&](const History& history) -> std::optional<std::string> {
                    compared = history.common_n.size();
                    apart = 0.0;
                    for (std::size_t n = 0; n < compared; ++n)
                        apart = std::max(
                            apart, glm::length(history.common_n[n] - history.steps[n].loads[0].force_n));
                    return {};
                },
                .compares = true});
    EXPECT_EQ(compared, 20u);
    EXPECT_EQ(apart, 0.0) << "bit for bit";
}

TEST_F(TrialTest, EndsWhenItIsRedIfNobodyWantsToKnowMore) {
    const Outcome outcome = outcome_of({.name = "spill",
                                        .script =
                                            [](Moment& m) {
                                                if (m.step == 5) m.faults = {{Fault::Place::Smoke, 7.0f}};
                                            },
                                        .ends_when_red = true,
                                        .puts_faults = true});
    EXPECT_EQ(outcome.steps, 6);
}

TEST_F(TrialTest, SolidsMayBeWhatNoSceneCanSay) {
    for (const char* name : {"distance-tenfold", "distance-tenth", "self-crossing"}) {
        const Outcome outcome = outcome_of(*cases_named(name).front());
        EXPECT_TRUE(outcome.verdict.pass) << name << ": " << outcome.verdict.reason;
        EXPECT_THAT(outcome.remark, HasSubstr("its surface is off by")) << name;
    }
}

TEST_F(TrialTest, AProgramThatGivesUpIsARedCell) {
    const Outcome outcome = outcome_of({.name = "impossible", .change = [](Scene& s) {
                                            s.solver.time_order = 2;
                                            s.fluid.viscosity_pa_s = 1.0;
                                        }});
    EXPECT_FALSE(outcome.verdict.pass);
    EXPECT_THAT(outcome.verdict.reason, HasSubstr("second order in time"));
}

TEST_F(TrialTest, NewExtremesOfTransportWouldBeSeen) {
    gles::FluidSetup setup;
    setup.cells = glm::ivec3(8);
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    TransportWatch watch(gpu);
    const auto step_after = [&](float believed, float real) {
        fluid->set_velocity(std::vector<glm::vec3>(9 * 9 * 9, glm::vec3(believed, 0.0f, 0.0f)));
        watch.begin_step(*fluid);
        fluid->set_velocity(std::vector<glm::vec3>(9 * 9 * 9, glm::vec3(real, 0.0f, 0.0f)));
        fluid->step(0.01, {}, false);
        return watch.overshoot_m_s();
    };
    EXPECT_EQ(step_after(1.0f, 1.0f), 0.0);
    EXPECT_NEAR(step_after(1.0f, 1.25f), 0.25, 1e-6);
    EXPECT_NEAR(step_after(-1.0f, -1.5f), 0.5, 1e-6);
}

TEST_F(TrialTest, WaitsLongEnoughForTheCalm) {
    // Nobody says so, but the ball goes on for ever.
    const Outcome outcome = outcome_of({.name = "restless",
                                        .drive = Drive::Steps,
                                        .bodies =
                                            [](const Moment& m, std::vector<gles::BodyState>& bodies) {
                                                bodies[0].velocity_m_s.x = std::cos(6.0 * m.time_s);
                                            }},
                                       500);
    EXPECT_FALSE(outcome.verdict.pass);
    EXPECT_THAT(outcome.verdict.reason, HasSubstr("5 s after the last disturbance the force is"));
}

// For 1000 of its 10 000 steps, and not with second order in time: docs/stability.md says what becomes of those.
TEST_F(TrialTest, WithoutFrictionAndForcingTransportMakesNoEnergyForALongTime) {
    for (const char* name : {"inviscid-first-order", "inviscid-maccormack"}) {
        const Outcome outcome = outcome_of(*cases_named(name).front(), 1000);
        EXPECT_TRUE(outcome.verdict.pass) << name << ": " << outcome.verdict.reason;
    }
}

TEST_F(TrialTest, OfTwoAtOnceBothHappen) {
    const Case wind{.name = "dense", .change = [](Scene& s) { s.fluid.density_kg_m3 = 1000.0; }};
    const Case still{.name = "still", .script = [](Moment& m) { m.hand_m = m.middle_m(); }};
    const Case* both[] = {&wind, &still};
    const Outcome outcome = try_out(gpu, both, kSmall, 20);
    EXPECT_TRUE(outcome.verdict.pass) << outcome.verdict.reason;
    EXPECT_EQ(outcome.verdict.largest_force_n, 0.0);
    EXPECT_GT(outcome_of(wind).verdict.largest_force_n,
              100.0 * outcome_of({.name = "stir"}).verdict.largest_force_n);
}

}  // namespace
}  // namespace eddy::stability
