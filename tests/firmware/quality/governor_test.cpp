#include "firmware/quality/governor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace eddy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

constexpr double kMinute = 60.0, kHour = 3600.0;
/// One step in this many is timed, as in `eddy run`.
constexpr int kMeasureEvery = 20;

/// What the machine does to a fluid that is asked for an update every period. Times in seconds since start.
struct World {
    GovernorSetup ladder{.step_ms = {4.0, 6.0, 9.0, 13.5, 20.0}, .tuned_rung = 3, .period = Seconds(0.02)};
    std::function<double(double)> load = [](double) {
        return 1.0;
    };                     ///< steps take so many times what was tuned
    double jitter = 0.05;  ///< of a step's time
    double noise = 0.0;    ///< of every interval and every measured step time, on top
    std::function<double(double, std::size_t)> surprise =  ///< [s] that no measured step time shows
        [](double, std::size_t) { return 0.0; };
    unsigned seed = 1;
};

struct Change {
    double at_s;
    std::size_t to;
};

/// The exhibit as the governor sees it: a step takes as long as its rung and the load say, and the next update comes after it,
/// but not before the period is over.
class Machine {
  public:
    explicit Machine(const World& world)
        : world_(world), governor_(world.ladder), rung_(world.ladder.tuned_rung), random_(world.seed) {}

    void run_until(double end_s) {
        while (now_s_ < end_s) {
            const double step_s =
                world_.ladder.step_ms[rung_] / 1e3 * world_.load(now_s_) * spread(world_.jitter);
            const double interval_s =
                std::max(world_.ladder.period.count(), step_s + world_.surprise(now_s_, rung_)) *
                spread(world_.noise);
            now_s_ += interval_s;
            updates_s_.push_back(now_s_);
            if (++updates_ % kMeasureEvery == 0) governor_.step_took(step_s * 1e3 * spread(world_.noise));
            if (const auto rung = governor_.update(Seconds(interval_s))) {
                changes_.push_back({now_s_, *rung});
                rung_ = *rung;
            }
        }
    }

    /// Least rate in any window of two seconds that begins at `from_s` or later, as a share of the target.
    double worst_rate(double from_s) const {
        const double window_s = 2.0;
        double worst = kInf;
        auto first = std::lower_bound(updates_s_.begin(), updates_s_.end(), from_s);
        for (auto last = first; last != updates_s_.end(); ++last) {
            while (*last - *first > window_s) ++first;
            if (*last - from_s < window_s) continue;
            const double updates = static_cast<double>(last - first);  // one more would count a fence post
            worst = std::min(worst, updates * world_.ladder.period.count() / (*last - *first));
        }
        return worst;
    }

    Governor& governor() { return governor_; }
    std::size_t rung() const { return rung_; }
    const std::vector<Change>& changes() const { return changes_; }
    std::size_t changes_after(double from_s) const {
        return static_cast<std::size_t>(std::count_if(changes_.begin(), changes_.end(),
                                                      [&](const Change& c) { return c.at_s > from_s; }));
    }

  private:
    double spread(double share) { return 1.0 + share * uniform_(random_); }

    World world_;
    Governor governor_;
    std::size_t rung_;
    std::minstd_rand random_;
    std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
    double now_s_ = 0.0;
    long updates_ = 0;
    std::vector<double> updates_s_;
    std::vector<Change> changes_;
};

/// Ladders as a tuning might leave them: two to seven rungs, each 1.15 to 2.5 times as dear as the one below, for 30 to 125 updates
/// a second; the tuned rung takes up to 0.85 of the period.
GovernorSetup any_ladder(unsigned seed) {
    std::minstd_rand random(seed);
    random.discard(10);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    GovernorSetup ladder{.step_ms = {}, .tuned_rung = 0, .period = Seconds(between(0.008, 0.033))};
    const std::size_t rungs = 2 + random() % 6;
    ladder.tuned_rung = 1 + random() % (rungs - 1);
    ladder.step_ms.assign(rungs, 0.0);
    ladder.step_ms[ladder.tuned_rung] = ladder.period.count() * 1e3 * between(0.5, 0.85);
    for (std::size_t i = ladder.tuned_rung; i-- > 0;)
        ladder.step_ms[i] = ladder.step_ms[i + 1] / between(1.15, 2.5);
    for (std::size_t i = ladder.tuned_rung + 1; i < rungs; ++i)
        ladder.step_ms[i] = ladder.step_ms[i - 1] * between(1.15, 2.5);
    return ladder;
}

std::function<double(double)> load_between(double from_s, double to_s, double load) {
    return [=](double t) { return t >= from_s && t < to_s ? load : 1.0; };
}

TEST(Governor, GetsTheRateBackWithinTwoSecondsOfAnyLoadThatTheCheapestRungBears) {
    std::minstd_rand random(2009);
    int stepped_down = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        World world{.ladder = any_ladder(seed), .seed = seed};
        const double bearable = 0.85 * world.ladder.period.count() * 1e3 / world.ladder.step_ms[0];
        // Doubled, or anything else.
        const double load = seed % 2 == 0 ? 2.0 : std::uniform_real_distribution<double>(1.0, 5.0)(random);
        if (load > bearable) continue;
        world.load = load_between(5.0, kHour, load);
        Machine machine(world);
        machine.run_until(2.0 * kMinute);
        EXPECT_GE(machine.worst_rate(7.0), 0.9) << "seed " << seed << ", load " << load;
        stepped_down += machine.governor().figures().steps_down > 0;
    }
    EXPECT_GT(stepped_down, 50);  // the worlds are not too easy
}

TEST(Governor, HasTheTunedQualityBackWithinAMinuteOnceTheLoadIsGone) {
    std::minstd_rand random(2010);
    int stepped_down = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        World world{.ladder = any_ladder(seed), .seed = seed};
        world.load = load_between(5.0, 30.0, std::uniform_real_distribution<double>(1.5, 5.0)(random));
        Machine machine(world);
        machine.run_until(30.0);
        stepped_down += machine.rung() < world.ladder.tuned_rung;
        machine.run_until(30.0 + kMinute);
        EXPECT_GE(machine.rung(), world.ladder.tuned_rung) << "seed " << seed;
        machine.run_until(5.0 * kMinute);
        EXPECT_GE(machine.rung(), world.ladder.tuned_rung) << "seed " << seed;
    }
    EXPECT_GT(stepped_down, 150);
}

/// Loads from a tenth to five times that of the tuning, over all rungs to start on.
template <typename Check>
void for_steady_loads(double noise, const Check& check) {
    std::minstd_rand random(2011);
    for (unsigned seed = 1; seed <= 40; ++seed) {
        World world{
            .ladder = seed % 3 == 0 ? World{}.ladder : any_ladder(seed), .noise = noise, .seed = seed};
        world.ladder.tuned_rung = random() % world.ladder.step_ms.size();
        const double load = 0.1 * std::pow(50.0, std::uniform_real_distribution<double>(0.0, 1.0)(random));
        world.load = [=](double) { return load; };
        Machine machine(world);
        machine.run_until(kHour + kMinute);
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed << ", load " << load << ", start " << world.ladder.tuned_rung);
        check(machine);
    }
}

TEST(Governor, DoesNotHuntUnderASteadyLoad) {
    for_steady_loads(0.0, [](const Machine& m) { EXPECT_LE(m.changes_after(kMinute), 3U); });
}

TEST(Governor, DoesNotHuntWhenEveryIntervalIsUpTo30PercentOff) {
    for_steady_loads(0.3, [](const Machine& m) { EXPECT_LE(m.changes_after(kMinute), 3U); });
}

TEST(Governor, GoesAsFarDownAsItTakesAtOnce) {
    World world;
    world.load = load_between(5.0, kHour, 4.0);  // of 4, 6, 9, 13.5 ms only the first stays below 20
    Machine machine(world);
    machine.run_until(kMinute);
    ASSERT_EQ(machine.changes().size(), 1U);
    EXPECT_EQ(machine.changes()[0].to, 0U);
    EXPECT_LT(machine.changes()[0].at_s, 6.0);
}

TEST(Governor, StaysWhereItIsWhenALateStepIsStillWithinTenPercent) {
    World world{.jitter = 0.0};
    world.load = load_between(5.0, kHour, 1.09 * 20.0 / 13.5);
    Machine machine(world);
    machine.run_until(kHour);
    EXPECT_EQ(machine.changes().size(), 0U);
}

TEST(Governor, WaitsTwoSecondsBetweenStepsDown) {
    // What delays each update costs the same on every rung, so that each rung disappoints.
    World world{.surprise = [](double, std::size_t) { return 0.025; }};
    Machine machine(world);
    machine.run_until(kHour);
    const auto& changes = machine.changes();
    ASSERT_EQ(changes.size(), 2U);  // and none up: there is room by the step times, but updates are late
    EXPECT_EQ(changes[1].to, 0U);
    EXPECT_GE(changes[1].at_s - changes[0].at_s, 2.0);
    EXPECT_LE(changes[1].at_s - changes[0].at_s, 2.1);
}

TEST(Governor, WaitsTwoSecondsAfterAStepUpWasTakenBackToo) {
    World world{.surprise = [](double t, std::size_t) { return t < 40.0 ? 0.0 : 0.025; }};
    world.load = load_between(5.0, 10.0, 1.8);
    Machine machine(world);
    machine.run_until(kMinute);
    const auto& changes = machine.changes();
    ASSERT_EQ(changes.size(), 4U);
    EXPECT_EQ(changes[1].to, 3U);  // up; then down twice
    EXPECT_GE(changes[3].at_s - changes[2].at_s, 2.0);
}

/// A second is lost once in `every_s`, `in_a_row` times.
std::function<double(double, std::size_t)> stalls(double every_s, int in_a_row) {
    return [=, due = every_s, left = in_a_row](double t, std::size_t) mutable {
        if (t < due) return 0.0;
        if (--left == 0) {
            due = t + every_s;
            left = in_a_row;
        }
        return 1.0;
    };
}

TEST(Governor, IsNotMovedByStallsOfASecond) {
    for (const double period_s : {0.008, 0.02, 0.033})
        for (const int in_a_row : {1, 2, 3}) {
            World world{.surprise = stalls(30.0, in_a_row)};
            world.ladder.period = Seconds(period_s);
            for (double& step : world.ladder.step_ms) step *= period_s / 0.02;
            world.load = [](double) { return 1.3; };  // 0.88 of the period
            Machine machine(world);
            machine.run_until(kHour);
            EXPECT_EQ(machine.changes().size(), 0U) << period_s << " s, " << in_a_row << " in a row";
        }
}

TEST(Governor, IsNotMovedByASlowSpellOfAThirdOfASecond) {
    for (const double period_s : {0.008, 0.02, 0.033}) {
        World world;
        world.ladder.period = Seconds(period_s);
        for (double& step : world.ladder.step_ms) step *= period_s / 0.02;
        world.load = [](double t) { return std::fmod(t, 30.0) < 29.7 ? 1.0 : 2.0; };
        Machine machine(world);
        machine.run_until(10.0 * kMinute);
        EXPECT_EQ(machine.changes().size(), 0U) << period_s << " s";
    }
}

TEST(Governor, LeavesAStallOutWhenItSaysHowLongStepsTake) {
    World world{.jitter = 0.0, .surprise = stalls(5.2, 1)};
    world.load = load_between(5.0, kHour, 1.8);  // 24.3 ms: a rung down fits
    Machine machine(world);
    machine.run_until(8.0);
    ASSERT_EQ(machine.changes().size(), 1U);
    EXPECT_EQ(machine.changes()[0].to, 2U);
    EXPECT_EQ(machine.governor().figures().reason, "steps took 24.3 ms, 20 are allowed");
}

TEST(Governor, DoesNotLetOneOddStepTimeDelayAStepUp) {
    World world;
    world.load = load_between(5.0, 30.0, 2.0);
    Machine machine(world);
    machine.run_until(45.0);
    machine.governor().step_took(1000.0);
    machine.run_until(60.0);
    EXPECT_EQ(machine.rung(), 3U);
}

TEST(Governor, DoesNotBelieveALullOfFifteenSeconds) {
    World world;
    world.load = [](double t) { return std::fmod(t, 30.0) < 15.0 ? 1.8 : 1.0; };
    Machine machine(world);
    machine.run_until(kHour);
    ASSERT_EQ(machine.changes().size(), 1U);
    EXPECT_EQ(machine.rung(), 2U);
}

TEST(Governor, GoesUpNoFurtherThanThereWasRoomAllTheTime) {
    World world;
    world.ladder = {.step_ms = {4.0, 6.0, 9.0}, .tuned_rung = 2, .period = Seconds(0.02)};
    world.load = [](double t) { return t < 5.0 ? 4.0 : t < 20.0 ? 2.5 : 1.0; };
    Machine machine(world);
    machine.run_until(kMinute);
    ASSERT_EQ(machine.changes().size(), 3U);
    EXPECT_EQ(machine.changes()[0].to, 0U);
    EXPECT_EQ(machine.changes()[1].to, 1U);
    EXPECT_EQ(machine.changes()[2].to, 2U);
}

TEST(Governor, DoesNotTakeAJumpOfTheClockForALongLull) {
    World world;
    world.load = load_between(5.0, 30.0, 1.8);
    Machine machine(world);
    machine.run_until(40.0);
    machine.governor().update(Seconds(86400.0));
    machine.run_until(45.0);
    EXPECT_EQ(machine.rung(), 2U);
}

/// The rung that it has after ten minutes at `load`, started on the cheapest of two and tuned to one of them.
std::size_t settles_on(std::size_t tuned_rung, double share_of_higher_rung) {
    World world;
    world.ladder = {.step_ms = {6.0, 16.0}, .tuned_rung = tuned_rung, .period = Seconds(0.02)};
    world.load = [=](double t) { return t < 5.0 ? 2.0 : share_of_higher_rung * 20.0 / 16.0; };
    Machine machine(world);
    machine.run_until(4.0);
    EXPECT_EQ(machine.rung(), 0U);
    machine.run_until(10.0 * kMinute);
    return machine.rung();
}

TEST(Governor, ReturnsToTheTunedRungWithATenthOfThePeriodToSpare) {
    EXPECT_EQ(settles_on(1, 0.86), 1U);
    EXPECT_EQ(settles_on(1, 0.94), 0U);
}

TEST(Governor, ClimbsAboveTheTunedRungOnlyWithThreeTenthsToSpare) {
    EXPECT_EQ(settles_on(0, 0.66), 1U);
    EXPECT_EQ(settles_on(0, 0.74), 0U);
}

/// Two rungs, of which the higher takes twice what its time says, until `until_s`.
World deceptive(double until_s) {
    World world{
        .surprise = [=](double t, std::size_t rung) { return t < until_s && rung == 1 ? 0.025 : 0.0; }};
    world.ladder = {.step_ms = {6.0, 12.0}, .tuned_rung = 0, .period = Seconds(0.02)};
    return world;
}

TEST(Governor, WaitsTwiceAsLongAfterEachStepUpThatHadToBeTakenBack) {
    Machine machine(deceptive(kInf));
    machine.run_until(kHour);
    std::vector<double> waits_s;
    double down_s = 0.0;
    for (const Change& c : machine.changes()) {
        if (c.to == 1) waits_s.push_back(c.at_s - down_s);
        down_s = c.at_s;
    }
    const auto about = [](double wait_s) {  // room is seen when a step is timed, every 0.4 s
        return testing::AllOf(testing::Ge(wait_s), testing::Le(wait_s + 1.0));
    };
    EXPECT_THAT(waits_s,
                testing::ElementsAre(about(20.0), about(40.0), about(80.0), about(160.0), about(320.0),
                                     about(600.0), about(600.0), about(600.0), about(600.0)));
}

TEST(Governor, TakesAStepUpThatWasAMistakeBackWithinASecond) {
    Machine machine(deceptive(kInf));
    machine.run_until(kMinute);
    ASSERT_GE(machine.changes().size(), 2U);
    EXPECT_LT(machine.changes()[1].at_s - machine.changes()[0].at_s, 1.0);
}

/// Seconds from the end of a load at `t_s` until the higher of two rungs is back, on a machine that had to take steps up back in its
/// first minutes.
double return_s(double t_s) {
    World world = deceptive(200.0);
    world.load = load_between(t_s - 10.0, t_s, 2.5);
    Machine machine(world);
    machine.run_until(t_s);
    EXPECT_EQ(machine.rung(), 0U);
    machine.run_until(t_s + 10.0 * kMinute);
    EXPECT_EQ(machine.rung(), 1U);
    return machine.changes().back().at_s - t_s;
}

TEST(Governor, ForgetsAfterAnHourWithoutTrouble) {
    EXPECT_GT(return_s(0.5 * kHour), 160.0);
    EXPECT_LT(return_s(1.2 * kHour), 30.0);
}

TEST(Governor, ClimbsRungByRungAfterAMistake) {
    World world{.surprise = [](double, std::size_t rung) { return rung == 3 ? 0.018 : 0.0; }};
    world.ladder = {.step_ms = {4.0, 6.0, 8.0, 10.0}, .tuned_rung = 3, .period = Seconds(0.02)};
    Machine machine(world);
    machine.run_until(kHour);
    std::vector<std::size_t> rungs;
    for (const Change& c : machine.changes()) rungs.push_back(c.to);
    rungs.resize(4);
    EXPECT_THAT(rungs, testing::ElementsAre(1, 3, 1, 2));
}

TEST(Governor, GoesUpOnlyWhenItIsToldHowLongStepsTake) {
    Governor governor({.step_ms = {4.0, 6.0}, .tuned_rung = 0, .period = Seconds(0.02)});
    for (int i = 0; i < 10000; ++i) {
        if (i < 100) governor.step_took(4.0);  // then never again
        ASSERT_EQ(governor.update(Seconds(0.02)), std::nullopt);
    }
}

TEST(Governor, IsNotMovedByGarbage) {
    Governor governor(World{}.ladder);
    for (int i = 0; i < 100'000; ++i) {
        for (const double bad : {kNan, kInf, -kInf, 0.0, -0.0, -0.02, -1e300}) {
            ASSERT_EQ(governor.update(Seconds(bad)), std::nullopt);
            governor.step_took(bad);
        }
        ASSERT_EQ(governor.update(Seconds(0.02)), std::nullopt);
        if (i % kMeasureEvery == 0) governor.step_took(13.5);
        if (i % 1000 == 0) {  // the clock jumped, by a day or a billion years
            ASSERT_EQ(governor.update(Seconds(86400.0)), std::nullopt);
            ASSERT_EQ(governor.update(Seconds(1e300)), std::nullopt);
            ASSERT_EQ(governor.update(Seconds(1e-300)), std::nullopt);
        }
    }
    EXPECT_EQ(governor.figures().steps_down + governor.figures().steps_up, 0U);
    // And then it still does its work.
    for (int i = 0; i < 50; ++i) governor.update(Seconds(0.027));
    EXPECT_EQ(governor.figures().steps_down, 1U);
}

TEST(Governor, RecoversFromStepTimesNoClockCanMean) {
    for (const double odd_ms : {1e-300, 1e300}) {
        World world;
        world.load = load_between(5.0, 10.0, 2.0);
        Machine machine(world);
        for (int i = 0; i < 10'000; ++i) machine.governor().step_took(odd_ms);
        machine.run_until(kMinute);
        EXPECT_EQ(machine.changes().size(), 2U) << odd_ms;
        EXPECT_EQ(machine.rung(), 3U) << odd_ms;
    }
}

TEST(Governor, SaysWhenTheCheapestSettingIsTooSlowAndWhenItNoLongerIs) {
    World world;
    world.ladder = {.step_ms = {15.0}, .tuned_rung = 0, .period = Seconds(0.02)};  // all there is
    world.load = load_between(60.0, 120.0, 2.0);
    Machine machine(world);
    machine.run_until(60.0);
    EXPECT_EQ(machine.governor().figures().trouble, "");
    machine.run_until(62.0);
    EXPECT_EQ(machine.governor().figures().trouble, "the cheapest setting is too slow for this machine");
    machine.run_until(120.0);
    EXPECT_EQ(machine.governor().figures().trouble, "the cheapest setting is too slow for this machine");
    machine.run_until(123.0);
    EXPECT_EQ(machine.governor().figures().trouble, "");
    EXPECT_EQ(machine.changes().size(), 0U);
}

TEST(Governor, FiguresCountUpdatesAndChanges) {
    World world{.jitter = 0.0};
    world.load = load_between(10.0, 30.0, 1.8);  // 24.3 ms: a rung down, and back
    Machine machine(world);
    EXPECT_EQ(machine.governor().figures().rung, 3U);
    EXPECT_EQ(machine.governor().figures().late_share, 0.0);
    EXPECT_EQ(machine.governor().figures().reason, "");

    machine.run_until(kMinute);
    ASSERT_EQ(machine.changes().size(), 2U);
    const GovernorFigures figures = machine.governor().figures();
    EXPECT_EQ(figures.rung, 3U);
    EXPECT_EQ(figures.steps_down, 1U);
    EXPECT_EQ(figures.steps_up, 1U);
    // Late were the updates between the load's begin and the step down, out of 50 a second.
    const double late = (machine.changes()[0].at_s - 10.0) / 0.0243;
    EXPECT_NEAR(figures.late_share, late / (50.0 * (kMinute - late * 0.0243) + late), 1.0 / 3000.0);
    // One part in a hundred of the load is still in the smoothed step time after twenty seconds.
    EXPECT_THAT(figures.reason, testing::AnyOf("steps will take 13.5 ms, 20 are allowed",
                                               "steps will take 13.6 ms, 20 are allowed"));
}

TEST(Governor, RefusesALadderThatMakesNoSense) {
    const Seconds period{0.02};
    EXPECT_THROW(Governor({.step_ms = {}, .tuned_rung = 0, .period = period}), std::invalid_argument);
    EXPECT_THROW(Governor({.step_ms = {4.0, 6.0}, .tuned_rung = 2, .period = period}), std::invalid_argument);
    EXPECT_THROW(Governor({.step_ms = {6.0, 4.0}, .tuned_rung = 0, .period = period}), std::invalid_argument);
    for (const double bad : {kNan, kInf, 0.0, -4.0}) {
        EXPECT_THROW(Governor({.step_ms = {bad}, .tuned_rung = 0, .period = period}), std::invalid_argument);
        EXPECT_THROW(Governor({.step_ms = {4.0}, .tuned_rung = 0, .period = Seconds(bad)}),
                     std::invalid_argument);
    }
    EXPECT_NO_THROW(Governor({.step_ms = {4.0, 4.0}, .tuned_rung = 1, .period = period}));
}

}  // namespace
}  // namespace eddy
