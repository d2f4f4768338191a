#include "firmware/exhibit/button.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// Looks at a button every millisecond and counts what it asks for.
struct Finger {
    Button button;
    Instant now{0};
    int clicks = 0, guides = 0, shutdowns = 0, factories = 0;

    /// Starts with the button up.
    Finger() { hold(100ms, false); }
    explicit Finger(bool pressed) { hold(1ms, pressed); }

    void hold(Instant time, std::optional<bool> closed) {
        for (const Instant end = now + time; now < end; now += 1ms) {
            const ButtonNews news = button.see(now, closed);
            clicks += news.click;
            guides += news.guide;
            shutdowns += news.shutdown;
            factories += news.factory;
        }
    }
    void press(Instant time) {
        hold(time, true);
        hold(100ms, false);
    }
    int all() const { return clicks + guides + shutdowns + factories; }
};

TEST(Button, AClickResetsTheExhibit) {
    Finger finger;
    finger.press(150ms);
    EXPECT_EQ(finger.clicks, 1);
    EXPECT_EQ(finger.all(), 1);
    finger.press(150ms);
    EXPECT_EQ(finger.clicks, 2);
}

TEST(Button, AClickLastsFrom30MillisecondsToTwoSeconds) {
    for (const auto& [time, clicks] : std::vector<std::pair<Instant, int>>{
             {1ms, 0}, {19ms, 0}, {29ms, 0}, {30ms, 1}, {2000ms, 1}, {2001ms, 0}, {2999ms, 0}}) {
        Finger finger;
        finger.press(time);
        EXPECT_EQ(finger.clicks, clicks) << time.count();
        EXPECT_EQ(finger.all(), clicks) << time.count();
    }
}

TEST(Button, HeldForThreeSecondsShowsTheGuidePagesAtOnceAndOnlyOnce) {
    Finger finger;
    finger.hold(3000ms, true);
    EXPECT_EQ(finger.guides, 0);
    finger.hold(1ms, true);
    EXPECT_EQ(finger.guides, 1);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Guide);
    finger.hold(6000ms, true);
    finger.hold(100ms, false);
    EXPECT_EQ(finger.all(), 1);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Up);
}

TEST(Button, HeldForTenSecondsShutsDownWhenItIsLetGo) {
    Finger finger;
    finger.hold(10'001ms, true);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Shutdown);
    EXPECT_EQ(finger.shutdowns, 0);
    finger.hold(100ms, false);
    EXPECT_EQ(finger.shutdowns, 1);
    EXPECT_EQ(finger.clicks, 0);
}

TEST(Button, LetGoBeforeTenSecondsDoesNotShutDown) {
    Finger finger;
    finger.press(9999ms);
    EXPECT_EQ(finger.shutdowns, 0);
    finger.press(10'000ms);
    EXPECT_EQ(finger.shutdowns, 1);
}

TEST(Button, StuckForMoreThanAMinuteIsAFaultAndShutsNothingDown) {
    Finger finger;
    finger.hold(60'001ms, true);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Shutdown);
    finger.hold(1ms, true);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Stuck);
    finger.hold(3'600'000ms, true);
    EXPECT_EQ(finger.guides, 1);
    finger.hold(100ms, false);
    EXPECT_EQ(finger.shutdowns, 0);
    EXPECT_EQ(finger.clicks, 0);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Up);
    finger.press(100ms);
    EXPECT_EQ(finger.clicks, 1) << "repaired, it works";
}

TEST(Button, HeldSinceTheStartForFiveSecondsAsksForTheFactorysConfiguration) {
    Finger finger(true);
    finger.hold(4999ms, true);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Down);
    finger.hold(1ms, true);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Factory);
    finger.hold(20'000ms, true);
    EXPECT_EQ(finger.all(), 0) << "it may be stuck";
    finger.hold(100ms, false);
    EXPECT_EQ(finger.factories, 1);
    EXPECT_EQ(finger.all(), 1) << "and for nothing else";
    finger.press(5500ms);
    EXPECT_EQ(finger.factories, 1) << "only a press that was there at the start";
    EXPECT_EQ(finger.guides, 1);
}

TEST(Button, StuckSinceTheStartIsStuckAndNothingElse) {
    Finger finger(true);
    finger.hold(61s, true);
    EXPECT_EQ(finger.button.phase(), Button::Phase::Stuck);
    finger.hold(100ms, false);
    EXPECT_EQ(finger.all(), 0);
    finger.press(100ms);
    EXPECT_EQ(finger.clicks, 1);
}

TEST(Button, HeldSinceTheStartAndLetGoSoonAsksForNothing) {
    for (const Instant time : {Instant(100ms), Instant(4900ms)}) {
        Finger finger(true);
        finger.hold(time, true);
        finger.hold(100ms, false);
        EXPECT_EQ(finger.all(), 0);
        finger.press(100ms);
        EXPECT_EQ(finger.clicks, 1);
    }
}

TEST(Button, ContactsThatBounceClickOnce) {
    Finger finger;
    const auto bounce = [&finger] {
        for (const Instant time : {Instant(1ms), Instant(3ms), Instant(2ms), Instant(7ms), Instant(1ms)}) {
            finger.hold(time, true);
            finger.hold(time, false);
        }
    };
    bounce();
    finger.hold(200ms, true);
    bounce();
    finger.hold(100ms, false);
    EXPECT_EQ(finger.clicks, 1);
    EXPECT_EQ(finger.all(), 1);
}

TEST(Button, AGapShorterThanABounceDoesNotEndAPress) {
    Finger finger;
    for (int i = 0; i < 4; ++i) {
        finger.hold(990ms, true);
        finger.hold(19ms, false);
    }
    EXPECT_EQ(finger.guides, 1);
    EXPECT_EQ(finger.clicks, 0);
}

TEST(Button, WhoseLineGoesAwayAsksForNothing) {
    for (const Instant time : {Instant(100ms), Instant(11s), Instant(61s)}) {
        Finger finger;
        finger.hold(time, true);
        const int before = finger.all();
        finger.hold(500ms, std::nullopt);
        EXPECT_EQ(finger.button.phase(), Button::Phase::Up);
        finger.hold(500ms, false);
        EXPECT_EQ(finger.all(), before);
        finger.press(100ms);
        EXPECT_EQ(finger.clicks, 1);
    }
}

TEST(Button, IsTheSameSeenEveryTenMilliseconds) {
    for (const int ms : {50, 1950}) {
        Button button;
        int clicks = 0;
        for (Instant now{0}; now < 3s; now += 10ms)
            clicks += button.see(now, now >= 100ms && now < 100ms + std::chrono::milliseconds(ms)).click;
        EXPECT_EQ(clicks, 1) << ms;
    }
}

}  // namespace
}  // namespace eddy
