#include "firmware/exhibit/panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <functional>
#include <thread>

#include "firmware/exhibit/panel_work.h"
#include "firmware/haptic/flight_rerun.h"
#include "hal/gpio/emulated_gpio.h"
#include "tests/firmware/haptic/loop_rig.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

GpioConfig all_wired() {
    GpioConfig config;
    config.button = "bridge:0";
    config.stop = "bridge:1";
    config.lamp_green = "header:0";
    config.lamp_amber = "header:1";
    config.lamp_red = "header:2";
    return config;
}

/// A panel on virtual time: button (joins its line to ground) and stop (opens) on a bridge, lamps on the board's header.
struct Desk {
    EmulatedGpio gpio;
    PanelWork work;
    Instant now{0};

    explicit Desk(const GpioConfig& config = all_wired(), const std::filesystem::path& stop_file = {})
        : work((make(gpio), gpio), config, stop_file) {}

    static void make(EmulatedGpio& gpio) {
        gpio.add("bridge", {"", ""}, false);
        gpio.add("header", {"G", "A", "R"});
        gpio.set_high("bridge:1", false);
    }
    void run(Instant time) {
        for (const Instant end = now + time; now < end; now += Panel::kPeriod) work.work(now);
    }
    void press_button(Instant time) {
        gpio.set_high("bridge:0", false);
        run(time);
        gpio.set_high("bridge:0", true);
        run(50ms);
    }
    void press_stop(bool pressed) { gpio.set_high("bridge:1", pressed); }
    bool stopped() { return work.stop_input().pressed(now); }
    std::string lit() const {
        std::string on;
        for (const char* name : {"G", "A", "R"})
            if (gpio.is_high(name)) on += name;
        return on;
    }
};

TEST(Panel, TellsOfAClickOnce) {
    Desk desk;
    desk.run(100ms);
    desk.press_button(200ms);
    desk.press_button(200ms);
    EXPECT_EQ(desk.work.news().resets, 2U);
    EXPECT_EQ(desk.work.news().resets, 0U);
}

// A crash, or a settings file that needs a new process, is no click.
TEST(Panel, AStopOutlivesTheProgramUntilSomebodyClicks) {
    const ScratchFolder folder;
    const std::filesystem::path file = folder.path() / "stopped";
    const auto was_held = [&](const std::function<void(Desk&)>& then) {
        Desk desk(all_wired(), file);
        const bool held = desk.work.stop_was_held();
        desk.run(100ms);
        then(desk);
        return held;
    };
    const auto nothing = [](Desk&) {};
    EXPECT_FALSE(was_held(nothing));
    EXPECT_FALSE(was_held([](Desk& desk) {
        desk.press_stop(true);
        desk.run(100ms);
        desk.press_stop(false);
        desk.run(1s);
    })) << "it was not yet";
    EXPECT_TRUE(was_held(nothing));
    EXPECT_TRUE(was_held([](Desk& desk) {
        desk.press_stop(true);
        desk.press_button(200ms);
    })) << "nor is a click while it is pressed the end of it";
    EXPECT_TRUE(was_held([](Desk& desk) { desk.press_button(200ms); }));
    EXPECT_FALSE(was_held(nothing)) << "somebody has clicked";
    EXPECT_FALSE(was_held([](Desk& desk) {
        desk.gpio.unplug("bridge");
        desk.run(1s);
    }));
    EXPECT_TRUE(was_held(nothing)) << "a bridge that went away counts as pressed";
}

TEST(Panel, ABridgeThatIsNotThereAtTheStartIsNoStop) {
    const ScratchFolder folder;
    EmulatedGpio gpio;
    PanelWork work(gpio, all_wired(), folder.path() / "stopped");
    for (Instant now{0}; now < 2s; now += Panel::kPeriod) work.work(now);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "stopped"));
}

TEST(Panel, TellsOfGuideAndShutdown) {
    Desk desk;
    desk.run(100ms);
    desk.press_button(4s);
    PanelNews news = desk.work.news();
    EXPECT_TRUE(news.guide);
    EXPECT_FALSE(news.shutdown);
    desk.press_button(11s);
    news = desk.work.news();
    EXPECT_TRUE(news.shutdown);
    EXPECT_EQ(news.resets, 0U);
}

TEST(Panel, HeldSinceTheStartAsksForTheFactorysConfiguration) {
    Desk desk;
    desk.gpio.set_high("bridge:0", false);
    desk.run(6s);
    EXPECT_FALSE(desk.work.news().factory) << "it may be stuck";
    EXPECT_EQ(desk.lit(), "GAR") << "let go";
    desk.gpio.set_high("bridge:0", true);
    desk.run(50ms);
    EXPECT_TRUE(desk.work.news().factory);
}

TEST(Panel, AContactThatBouncesIsOneClick) {
    Desk desk;
    desk.run(100ms);
    desk.gpio.bounce("bridge:0", {false, true, false, true, true, false});
    desk.press_button(300ms);
    desk.gpio.bounce("bridge:0", {true, false, true, false, false});
    desk.run(500ms);
    EXPECT_EQ(desk.work.news().resets, 1U);
}

TEST(Panel, SeesTheStopInputTheFirstTimeItLooks) {
    Desk desk;
    EXPECT_TRUE(desk.stopped()) << "before anybody has looked";
    desk.work.work(desk.now);
    EXPECT_FALSE(desk.stopped());
    desk.press_stop(true);
    desk.work.work(desk.now += 10ms);
    EXPECT_TRUE(desk.stopped());
}

TEST(Panel, ATapOnTheStopThatComesAndGoesWhileNobodyLooksCountsAndASparkDoesNot) {
    GpioConfig config = all_wired();
    config.stop = "S";
    Desk desk(config);
    desk.gpio.add("board", {"S"});
    desk.gpio.set_high("S", false);
    const auto tap = [&] {
        desk.gpio.set_high("S", true);
        desk.gpio.set_high("S", false);
    };
    desk.run(100ms);
    ASSERT_FALSE(desk.stopped());
    tap();
    desk.work.work(desk.now);  // woken by the edge, in time
    EXPECT_FALSE(desk.stopped()) << "no finger is as quick as that";
    tap();
    desk.work.work(desk.now += 100ms);  // the machine was busy
    EXPECT_TRUE(desk.stopped());
}

TEST(Panel, AStopIsLetGoWhenItRests) {
    Desk desk;
    desk.run(100ms);
    desk.press_stop(true);
    desk.run(100ms);
    desk.press_stop(false);
    desk.gpio.bounce("bridge:1", {false, true, false, true, false, true});
    for (int i = 0; i < 7; ++i) {
        desk.run(10ms);
        EXPECT_TRUE(desk.stopped()) << i;
    }
    desk.run(20ms);
    EXPECT_FALSE(desk.stopped());
}

TEST(Panel, OnlyAClickAfterAStopBringsTheForceBack) {
    Desk desk;
    desk.run(100ms);
    desk.press_button(200ms);
    EXPECT_TRUE(desk.work.news().force_back);
    EXPECT_FALSE(desk.work.news().force_back);
    // Not one that is heard only after the stop, nor one while it lasts.
    desk.press_button(200ms);
    desk.press_stop(true);
    desk.run(100ms);
    desk.press_button(200ms);
    desk.press_stop(false);
    desk.run(100ms);
    PanelNews news = desk.work.news();
    EXPECT_FALSE(news.force_back);
    EXPECT_EQ(news.resets, 2U) << "the show begins anew all the same";
    desk.press_button(200ms);
    EXPECT_TRUE(desk.work.news().force_back);
}

TEST(Panel, WithoutAStopInputNothingIsStopped) {
    GpioConfig config = all_wired();
    config.stop.clear();
    Desk desk(config);
    EXPECT_FALSE(desk.stopped());
    EXPECT_TRUE(desk.work.stop_is_known());
    desk.run(100ms);
    desk.gpio.unplug("bridge");
    desk.run(5s);
    EXPECT_FALSE(desk.stopped());
}

TEST(Panel, ABridgeThatIsUnpluggedStopsAndPressesNoButton) {
    Desk desk;
    desk.run(100ms);
    desk.gpio.set_high("bridge:0", false);
    desk.run(11s);  // let go now it would shut down
    desk.gpio.unplug("bridge");
    desk.run(10ms);
    EXPECT_TRUE(desk.stopped());
    PanelNews news = desk.work.news();
    EXPECT_FALSE(news.shutdown);
    EXPECT_THAT(news.trouble, HasSubstr("GPIO line 'bridge:0' went away"));
    EXPECT_THAT(news.trouble, HasSubstr("GPIO line 'bridge:1' went away"));
    desk.run(5s);
    EXPECT_TRUE(desk.stopped());
    EXPECT_THAT(desk.work.news().trouble, HasSubstr("there is no GPIO chip 'bridge'"));

    desk.gpio.set_high("bridge:0", true);
    desk.gpio.plug_in("bridge");
    desk.run(1100ms);
    EXPECT_FALSE(desk.stopped());
    news = desk.work.news();
    EXPECT_EQ(news.trouble, "");
    EXPECT_EQ(news.resets, 0U);
    EXPECT_FALSE(news.shutdown);
    desk.press_button(100ms);
    EXPECT_EQ(desk.work.news().resets, 1U);
}

TEST(Panel, LooksForALineThatIsAwayOnceASecond) {
    Desk desk;
    desk.run(100ms);
    desk.gpio.unplug("bridge");
    desk.run(10ms);
    desk.gpio.plug_in("bridge");
    desk.run(900ms);
    EXPECT_TRUE(desk.stopped());
    desk.run(200ms);
    EXPECT_FALSE(desk.stopped());
}

TEST(Panel, SaysWhatIsWrongWithLinesItCannotHave) {
    GpioConfig config = all_wired();
    config.lamp_green = "Gren";
    Desk desk(config);
    desk.gpio.use_elsewhere("A", "gpio-keys");
    desk.gpio.refuse("R", EINVAL);
    desk.run(10ms);
    const std::string trouble = desk.work.news().trouble;
    EXPECT_THAT(trouble, HasSubstr("there is no GPIO line called 'Gren'"));
    EXPECT_THAT(trouble, HasSubstr("is used by 'gpio-keys'"));
    EXPECT_THAT(trouble, HasSubstr("Invalid argument"));
    EXPECT_THAT(trouble, testing::Not(HasSubstr("went away"))) << "they never were there";
}

TEST(Panel, LightsTheLampsOfACode) {
    Desk desk;
    desk.work.show(LampCode::Show);
    desk.run(600ms);
    EXPECT_EQ(desk.lit(), "G");
    EXPECT_EQ(desk.work.handle_light(), HandleLight{.green = true});
    desk.work.show(LampCode::Starting);
    desk.run(600ms);
    EXPECT_EQ(desk.lit(), "A");
    desk.work.darken(desk.now);
    EXPECT_EQ(desk.lit(), "");
}

TEST(Panel, LightsLampsThatHangOnTheSupply) {
    GpioConfig config = all_wired();
    config.lamps_active_low = true;
    Desk desk(config);
    desk.work.show(LampCode::Show);
    desk.run(600ms);
    EXPECT_EQ(desk.lit(), "AR");
    desk.work.darken(desk.now);
    EXPECT_EQ(desk.lit(), "GAR");
}

TEST(Panel, OneLampAloneCountsOutTheCode) {
    for (const bool one : {true, false}) {
        GpioConfig config = all_wired();
        config.lamp_green.clear();
        if (one) config.lamp_amber.clear();
        Desk desk(config);
        desk.work.show(LampCode::Rejected);
        desk.run(1s);
        int blinks = 0;
        bool on = desk.gpio.is_high("R");
        for (int i = 0; i < 1000; ++i) {
            desk.run(10ms);
            const bool now = desk.gpio.is_high("R");
            blinks += now && !on;
            on = now;
        }
        EXPECT_EQ(blinks, one ? 12 : 0) << "three in 2.5 s";
    }
}

TEST(Panel, TheLampsOfAStopGoBeforeAllOthersAndThoseAskedForComeBack) {
    Desk desk;
    desk.work.show(LampCode::Show);
    desk.run(1s);
    desk.press_stop(true);
    desk.run(300ms);
    EXPECT_EQ(desk.lit(), "R");
    EXPECT_TRUE(desk.work.handle_light().red);
    desk.press_stop(false);
    desk.run(600ms);
    EXPECT_EQ(desk.lit(), "G");
}

TEST(Panel, TheLampsSayWhenALongPressIsLongEnough) {
    Desk desk;
    desk.work.show(LampCode::Attract);
    desk.run(100ms);
    desk.gpio.set_high("bridge:0", false);
    desk.run(10'400ms);
    EXPECT_EQ(desk.lit(), "GAR");
    desk.run(60s);
    EXPECT_TRUE(desk.work.news().button_stuck);
    EXPECT_THAT(desk.lit(), testing::AnyOf("R", ""));
    desk.gpio.set_high("bridge:0", true);
    desk.run(1s);
    EXPECT_FALSE(desk.work.news().button_stuck);
    EXPECT_EQ(desk.lit(), "G");
}

TEST(Panel, LampsThatWereAwayAreLitAgain) {
    Desk desk;
    desk.work.show(LampCode::Show);
    desk.run(1s);
    desk.gpio.unplug("header");
    desk.run(1500ms);  // a lamp that does not change is found out when it is said again
    const std::string trouble = desk.work.news().trouble;
    EXPECT_EQ(std::count(trouble.begin(), trouble.end(), '\n'), 2) << "three lines are away";
    desk.gpio.set_high("G", false);
    desk.gpio.plug_in("header");
    desk.run(1500ms);
    EXPECT_EQ(desk.lit(), "G");
    EXPECT_EQ(desk.work.news().trouble, "");
}

/// The panel, and a hand that feels 4 N, on one clock.
struct DeskAndHand {
    Desk desk;
    LoopRig rig;

    void run(int ms) {
        for (int i = 0; i < ms; ++i) {
            if (rig.ticks % 10 == 0) desk.work.work(rig.now());
            desk.now = rig.now();
            rig.stop_input.found(desk.stopped(), desk.now);
            if (desk.work.news().resets > 0) {
                ++rig.orders.restarts;
                rig.order();
            }
            rig.tick();
        }
    }
    double force_n() const { return glm::length(rig.device.commanded_n); }
};

TEST(Panel, AStopTakesTheForceAwayUntilAClickBringsItBackSlowly) {
    DeskAndHand all;
    all.run(2000);
    ASSERT_GT(all.force_n(), 4.0);
    all.desk.press_stop(true);
    all.run(10);
    all.rig.tick();
    EXPECT_EQ(all.force_n(), 0.0);
    all.run(1000);
    all.desk.press_stop(false);
    all.run(3000);
    EXPECT_EQ(all.force_n(), 0.0) << "let go is not restarted";
    EXPECT_EQ(all.rig.report().reason, GateReason::Stopped);

    all.desk.gpio.set_high("bridge:0", false);
    all.run(200);
    all.desk.gpio.set_high("bridge:0", true);
    while (all.rig.report().reason == GateReason::Stopped) all.run(1);
    all.run(500);
    EXPECT_GT(all.force_n(), 0.5);
    EXPECT_LT(all.force_n(), 2.8) << "half of the force half a second later";
    all.run(600);
    EXPECT_GT(all.force_n(), 4.0);

    const std::optional<Flight> flight = all.rig.flights.take();
    ASSERT_TRUE(flight);
    EXPECT_EQ(flight->cause, GateReason::Stopped);
    EXPECT_TRUE(flight->ticks.back().in.orders.stop);
    EXPECT_EQ(rerun(*flight).differing, 0U);
}

TEST(Panel, AStopThatNobodyLooksAtTakesTheForceAwayUntilAClick) {
    DeskAndHand all;
    all.run(2000);
    ASSERT_GT(all.force_n(), 4.0);
    all.rig.run(520);  // the panel's thread hangs
    EXPECT_EQ(all.force_n(), 0.0);
    all.run(1000);
    EXPECT_EQ(all.force_n(), 0.0) << "it is back: that is no restart";
    EXPECT_EQ(all.rig.report().reason, GateReason::Stopped);
    all.desk.gpio.set_high("bridge:0", false);
    all.run(200);
    all.desk.gpio.set_high("bridge:0", true);
    all.run(2000);
    EXPECT_GT(all.force_n(), 4.0);
}

TEST(Panel, AClickWhileTheStopIsPressedBringsNothingBack) {
    DeskAndHand all;
    all.run(2000);
    all.desk.press_stop(true);
    all.run(100);
    all.desk.gpio.set_high("bridge:0", false);
    all.run(200);
    all.desk.gpio.set_high("bridge:0", true);
    all.run(1000);
    all.desk.press_stop(false);
    all.run(3000);
    EXPECT_EQ(all.force_n(), 0.0);
}

// --- on its own thread -----------------------------------------------------------------------------------------

/// Whether it becomes true within ten seconds: long, for a busy machine.
bool soon(const std::function<bool()>& is) {
    for (int i = 0; i < 10'000; ++i) {
        if (is()) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

TEST(PanelThread, SeesStopAndButtonAndBeatsAndEndsInTheDark) {
    const RealClock clock;
    EmulatedGpio gpio;
    Desk::make(gpio);
    {
        Panel panel(gpio, all_wired(), clock);
        const auto stopped = [&] { return panel.stop_input().pressed(clock.now()); };
        EXPECT_TRUE(soon([&] { return panel.settled(); }));
        EXPECT_FALSE(stopped());
        panel.show(LampCode::Show);
        EXPECT_TRUE(soon([&] { return gpio.is_high("G"); }));
        EXPECT_EQ(panel.handle_light(), HandleLight{.green = true});
        gpio.set_high("bridge:1", true);
        EXPECT_TRUE(soon(stopped));
        EXPECT_TRUE(soon([&] { return gpio.is_high("R"); }));
        gpio.set_high("bridge:1", false);
        EXPECT_TRUE(soon([&] { return !stopped(); }));
        const std::uint64_t beats = panel.beats();
        EXPECT_TRUE(soon([&] { return panel.beats() > beats + 5; }));
        gpio.set_high("bridge:0", false);
        std::this_thread::sleep_for(100ms);
        gpio.set_high("bridge:0", true);
        std::uint64_t clicks = 0;
        EXPECT_TRUE(soon([&] { return (clicks += panel.news().resets) == 1; }));
    }
    for (const char* lamp : {"G", "A", "R"}) EXPECT_FALSE(gpio.is_high(lamp)) << lamp;
    for (const GpioChip& chip : gpio.chips())
        for (const GpioLineInfo& line : chip.lines) EXPECT_FALSE(line.used) << "given back";
}

/// A bridge whose driver does not come back from a look while it hangs.
class HangingGpio final : public Gpio {
  public:
    explicit HangingGpio(EmulatedGpio& gpio) : gpio_(gpio) {}
    std::vector<GpioChip> chips() override { return gpio_.chips(); }
    std::unique_ptr<GpioLine> request(const std::string& chip, unsigned offset,
                                      const GpioWish& wish) override {
        return std::make_unique<Line>(*this, gpio_.request(chip, offset, wish));
    }
    void hang(bool hangs) { hangs_ = hangs; }

  private:
    class Line final : public GpioLine {
      public:
        Line(const HangingGpio& gpio, std::unique_ptr<GpioLine> line) : gpio_(gpio), line_(std::move(line)) {}
        bool active() override {
            const bool was = line_->active();
            while (gpio_.hangs_) std::this_thread::sleep_for(1ms);
            return was;
        }
        void set(bool active) override { line_->set(active); }
        int edges_fd() const override { return line_->edges_fd(); }
        bool take_edges() override { return line_->take_edges(); }

      private:
        const HangingGpio& gpio_;
        std::unique_ptr<GpioLine> line_;
    };
    EmulatedGpio& gpio_;
    std::atomic<bool> hangs_{false};
};

TEST(PanelThread, ABridgeThatHangsStopsWithinHalfASecondAndUntilItAnswers) {
    const RealClock clock;
    EmulatedGpio emulated;
    Desk::make(emulated);
    HangingGpio gpio(emulated);
    Panel panel(gpio, all_wired(), clock);
    const auto stopped = [&] { return panel.stop_input().pressed(clock.now()); };
    EXPECT_TRUE(soon([&] { return panel.settled() && !stopped(); }));
    gpio.hang(true);
    const Instant hung = clock.now();
    EXPECT_TRUE(soon(stopped));
    EXPECT_GT(clock.now() - hung, StopInput::kLookCounts - 50ms);
    std::this_thread::sleep_for(50ms);
    const std::uint64_t beats = panel.beats();
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(panel.beats(), beats) << "who watches it is told";
    EXPECT_EQ(panel.news().resets, 0U) << "and may ask all the same";
    gpio.hang(false);
    EXPECT_TRUE(soon([&] { return !stopped(); }));
}

TEST(PanelThread, ABridgeThatHangsFromTheStartKeepsNobodyWaiting) {
    const RealClock clock;
    EmulatedGpio emulated;
    Desk::make(emulated);
    HangingGpio gpio(emulated);
    gpio.hang(true);
    const Panel panel(gpio, all_wired(), clock, {}, 100ms);
    EXPECT_FALSE(panel.settled());
    EXPECT_TRUE(soon([&] { return panel.settled(); }));
    EXPECT_TRUE(panel.stop_input().pressed(clock.now()));
    gpio.hang(false);
}

TEST(PanelThread, AnEdgeWakesIt) {
    EmulatedGpio gpio;
    gpio.add("header", {"button", "stop"});
    GpioConfig config;
    config.button = "button";
    config.stop = "stop";
    gpio.set_high("stop", false);
    const RealClock clock;
    Panel panel(gpio, config, clock);
    const std::uint64_t before = panel.beats();
    int edges = 0;
    // Each waits for the one before, so that none is joined with another: more beats than the clock alone gives.
    const Instant began = clock.now();
    while (edges < 200) {
        gpio.set_high("stop", ++edges % 2 == 1);
        const std::uint64_t seen = panel.beats();
        ASSERT_TRUE(soon([&] { return panel.beats() > seen; }));
    }
    const auto by_the_clock = static_cast<std::uint64_t>((clock.now() - began) / Panel::kPeriod);
    EXPECT_GE(panel.beats() - before, 150U);
    EXPECT_GT(panel.beats() - before, by_the_clock + 20);
}

TEST(PanelThread, WaitsForABridgeThatComesUpLater) {
    EmulatedGpio gpio;
    Desk::make(gpio);
    gpio.unplug("bridge");
    std::thread later([&gpio] {
        std::this_thread::sleep_for(200ms);
        gpio.plug_in("bridge");
    });
    const RealClock clock;
    const Panel panel(gpio, all_wired(), clock, {}, 60s);
    EXPECT_FALSE(panel.settled());
    EXPECT_TRUE(soon([&] { return panel.settled(); }));
    EXPECT_FALSE(panel.stop_input().pressed(clock.now()));
    later.join();
}

TEST(PanelThread, DoesNotWaitForeverAndIsStoppedThen) {
    EmulatedGpio gpio;
    const RealClock clock;
    const Panel panel(gpio, all_wired(), clock, {}, 100ms);
    EXPECT_TRUE(soon([&] { return panel.settled(); }));
    EXPECT_TRUE(panel.stop_input().pressed(clock.now()));
    Panel unwired(gpio, GpioConfig{}, clock, {}, 60s);
    EXPECT_TRUE(unwired.settled());
    EXPECT_FALSE(unwired.stop_input().pressed(clock.now()));
    EXPECT_EQ(unwired.news().trouble, "");
}

}  // namespace
}  // namespace eddy
