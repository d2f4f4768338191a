#include "firmware/stability/criteria.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eddy::stability {
namespace {

/// So many steps of 20 ms, with a force along x of the given size on one body.
History with_force(long steps, const std::function<double(double)>& force_n) {
    History history;
    history.planned_steps = steps;
    for (long n = 1; n <= steps; ++n) {
        const double t = 0.02 * static_cast<double>(n);
        history.steps.push_back(
            {.time_s = t, .dt_s = 0.02, .loads = {{{force_n(t), 0.0, 0.0}, {}}}, .bodies = {{}}});
    }
    return history;
}

/// As many looks as steps, with what `set` makes of each.
History with_looks(long steps, const std::function<void(History::Look&, double)>& set) {
    History history;
    history.planned_steps = steps;
    history.start_energy_j = 1.0;
    for (long n = 0; n < steps; ++n) {
        History::Look look{.step = n};
        set(look, static_cast<double>(n) / static_cast<double>(steps));
        history.looks.push_back(look);
    }
    return history;
}

TEST(Criterion, GrowthIsToldFromALevel) {
    const auto energy = [](double power) {
        return with_looks(
            1000, [power](History::Look& look, double share) { look.energy_j = std::pow(share, power); });
    };
    EXPECT_FALSE(energy_levels_off()(energy(0.1)));
    EXPECT_TRUE(energy_levels_off()(energy(1.0)));
}

TEST(Criterion, EnergyFarBelowThatOfABodysSpeedMayGrow) {
    const auto growing_to = [](double share_of_all) {
        History history = with_looks(1000, [&](History::Look& look, double share) {
            look.energy_j = share_of_all * 0.5 * History{}.tank.mass_kg() * share;
        });
        history.steps.push_back({.bodies = {{.velocity_m_s = {1.0, 0.0, 0.0}}}});
        return history;
    };
    EXPECT_FALSE(energy_levels_off_or_is_small()(growing_to(0.09)));
    EXPECT_TRUE(energy_levels_off_or_is_small()(growing_to(0.2)));
}

TEST(Criterion, EnergyThatRisesIsFoundHoweverLate) {
    const auto kink = [](double rise, double start_j) {
        History history = with_looks(1000, [rise](History::Look& look, double share) {
            look.energy_j = share < 0.9 ? 1.0 - share : 0.1 * (1.0 + rise);
        });
        history.start_energy_j = start_j;
        return history;
    };
    EXPECT_FALSE(energy_never_rises()(kink(0.0, 1.0)));
    EXPECT_TRUE(energy_never_rises()(kink(0.05, 1.0)));
    EXPECT_TRUE(energy_never_rises()(kink(0.0, 0.9))) << "in the first step";
}

TEST(Criterion, AModeThatStaysIsFound) {
    const auto left = [](double share) {
        return with_looks(200, [share](History::Look& look, double) { look.energy_j = share; });
    };
    EXPECT_FALSE(energy_decays(100)(left(0.09)));
    EXPECT_TRUE(energy_decays(100)(left(0.11)));
}

TEST(Criterion, AFaultThatIsNotForgottenIsFound) {
    const auto differs = [](double later_n, double common_n) {
        History history;
        for (int n = 0; n < 60; ++n) {
            history.common_n.emplace_back(common_n, 0.0, 0.0);
            const double off_n = n < 10 ? 0.0 : n < 50 ? 1.0 : later_n;
            history.steps.push_back(
                {.disturbed = true, .loads = {{.force_n = {common_n + off_n, 0.0, 0.0}}}});
        }
        return history;
    };
    EXPECT_FALSE(is_forgotten(10, 40)(differs(0.09, 0.0)));
    EXPECT_TRUE(is_forgotten(10, 40)(differs(0.11, 0.0)));
    // Of forces ten thousand times as large that is rounding.
    EXPECT_FALSE(is_forgotten(10, 40)(differs(0.9, 1e4)));
    EXPECT_TRUE(is_forgotten(10, 40)(differs(0.9, 5e3)));
}

TEST(Criterion, VolumeIsBalancedAgainstTheMostThatFlowedIn) {
    const auto leak = [](double net) {
        return with_looks(100, [net](History::Look& look, double share) {
            look.in_m3_s = share < 0.5 ? 1.0 : 0.0;
            look.net_m3_s = net;
        });
    };
    EXPECT_FALSE(volume_balances(0.01)(leak(0.009)));
    EXPECT_TRUE(volume_balances(0.01)(leak(-0.011)));
}

TEST(Criterion, AFluidThatDrivesTheHandIsFound) {
    History history = with_force(100, [](double) { return 1.0; });
    for (History::Step& step : history.steps) step.bodies[0].velocity_m_s = {-0.1, 0.0, 0.0};
    EXPECT_FALSE(gives_back_no_more()(history));
    for (History::Step& step : history.steps) step.bodies[0].velocity_m_s = {0.1, 0.0, 0.0};
    EXPECT_TRUE(gives_back_no_more()(history));
}

TEST(Criterion, AJumpOfTheForceIsFound) {
    EXPECT_FALSE(force_is_continuous(0, 0.25, 5)(with_force(100, [](double t) { return std::sin(t); })));
    EXPECT_TRUE(
        force_is_continuous(0, 0.25, 5)(with_force(100, [](double t) { return t < 1.0 ? 1.0 : 0.7; })));
}

TEST(Criterion, AStepOfNoTimeMayNotChangeTheForce) {
    History history = with_force(20, [](double) { return 1.0; });
    history.steps[9].dt_s = 1e-9;
    EXPECT_FALSE(no_time_no_news()(history));
    history.steps[9].loads[0].force_n.x = 1.01;
    EXPECT_TRUE(no_time_no_news()(history));
    history.steps[9].loads[0].force_n.x = std::nan("");
    EXPECT_TRUE(no_time_no_news()(history));
}

TEST(Criterion, TheHandIsLetGoInTime) {
    const auto fading = [](double until_s) {
        History history;
        for (int ms = 1; ms <= 500; ++ms) {
            const double t = 1e-3 * ms;
            history.ticks.push_back({t, t < until_s ? 1.0 : 0.0, t < 0.2});
        }
        history.steps = {{.dt_s = 0.02}};
        return history;
    };
    // The last answer came at 0.2 s, so that the first that is missing was due at 0.22 s.
    EXPECT_FALSE(hand_let_go(0.1)(fading(0.315)));
    EXPECT_TRUE(hand_let_go(0.1)(fading(0.325)));
}

TEST(Criterion, ForcesAfterAResetAreComparedBitForBit) {
    History history = with_force(30, [](double t) { return t; });
    for (std::size_t n = 0; n < 30; ++n) {
        history.steps[n].resets = static_cast<long>(n / 10);
        history.steps[n].loads[0].force_n.x = static_cast<double>(n % 10);
    }
    EXPECT_FALSE(same_after_each_reset()(history));
    history.steps[25].loads[0].force_n.x += 1e-15 * 8;
    EXPECT_TRUE(same_after_each_reset()(history));
}

TEST(Criterion, ALineBesideThoseOfTheMotionIsFound) {
    const auto shaken = [](double other) {
        return with_force(400, [other](double t) {
            return std::sin(20.0 * std::numbers::pi * t) + other * std::sin(26.0 * std::numbers::pi * t);
        });
    };
    EXPECT_FALSE(no_other_lines(10.0)(shaken(0.04)));
    EXPECT_TRUE(no_other_lines(10.0)(shaken(0.06)));
}

/// A ball of a fifth of a tank of 8 cells of 0.1 m comes in through a wall at 1 m/s; the force rises by 1 N over so many steps.
History coming_in(double rises_in_steps) {
    History history;
    history.tank.cell_m = 0.1;
    for (int n = 0; n < 100; ++n) {
        const double x = -0.3 + 0.01 * n;  // wholly in from step 46 on
        const double force = std::clamp((n - 20) / rises_in_steps, 0.0, 1.0);
        history.steps.push_back({.time_s = 0.01 * n,
                                 .dt_s = 0.01,
                                 .loads = {{{force, 0.0, 0.0}, {}}},
                                 .bodies = {{.centre_m = {x, 0.4, 0.4}}}});
    }
    return history;
}

TEST(Criterion, ABallThatComesBackMayPushOnlyAsItComesIn) {
    EXPECT_FALSE(returns_smoothly()(coming_in(16.0)));
    EXPECT_TRUE(returns_smoothly()(coming_in(4.0)));
    // Going out again it may.
    History out = coming_in(4.0);
    for (History::Step& step : out.steps) step.bodies[0].centre_m.x = 0.4 - step.time_s;
    EXPECT_FALSE(returns_smoothly()(out));
}

TEST(Criterion, ForcesThatTheFluidsMomentumDoesNotExplainAreFound) {
    History history = with_force(20, [](double) { return 1.0; });
    for (History::Step& step : history.steps) {
        step.loads.push_back({{-1.0, 0.0, 0.0}, {}});
        step.methods = {{.box_n = {1.5, 0.0, 0.0}}, {.box_n = {-1.5, 0.0, 0.0}}};
    }
    EXPECT_FALSE(forces_balance(1e-3)(history)) << "what one gives the other is between them";
    history.steps[7].methods[0].box_n.x += 0.01;
    EXPECT_TRUE(forces_balance(1e-3)(history));
    EXPECT_EQ(remark_on_balance()(history), "forces and the fluid's momentum agree within 0.005 of the peak");
}

TEST(Criterion, AForceInOtherUnitsIsComparedWithThatOfTheCommonScene) {
    History history = with_force(20, [](double t) { return 1e-9 * t; });
    for (const History::Step& step : history.steps) history.common_n.push_back(1e9 * step.loads[0].force_n);
    EXPECT_FALSE(same_as_common(1e-9, 1e-5)(history));
    history.common_n[5].x += 1e-5;
    EXPECT_TRUE(same_as_common(1e-9, 1e-5)(history));
    EXPECT_TRUE(same_as_common(1e-8, 1e-5)(history));
}

TEST(Remark, SaysWhatStepsTakeWhenNumbersAreSmall) {
    History history = with_force(100, [](double) { return 1.0; });
    for (std::size_t n = 0; n < 100; ++n) history.steps[n].wall_s = n < 20 ? 0.01 : 0.015;
    EXPECT_EQ(remark_on_time()(history),
              "a step of the last fifth takes 1.50 times as long as one of the first");
}

TEST(Criterion, OfARunWithoutAStepNothingIsWrong) {
    EXPECT_FALSE(no_time_no_news()({}));
    EXPECT_FALSE(no_other_lines(10.0)({}));
    EXPECT_FALSE(hand_let_go(0.1)({}));
}

TEST(Criterion, OfAllTheFirstThatFailsIsNamed) {
    const auto says = [](const char* text) {
        return Criterion(
            [text](const History&) { return text ? std::optional<std::string>(text) : std::nullopt; });
    };
    EXPECT_EQ(all_of({says(nullptr), says("a"), says("b")})({}), "a");
    EXPECT_EQ(all_of({says(nullptr)})({}), std::nullopt);
}

}  // namespace
}  // namespace eddy::stability
