#include "firmware/stability/hand_fuzz.h"

#include <cmath>

#include "firmware/stability/random_hand.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::stability {
namespace {

using HandFuzzTest = gles::GlTest;

Scene coarse() {
    return load_scene("stir", std::vector<std::string>{"tank.cells=[8, 8, 8]"}).scene;
}

TEST_F(HandFuzzTest, NoRandomHandGetsAForceItMustNotGet) {
    std::set<GateReason> reasons;
    double most_n = 0.0;
    std::uint64_t clamped = 0, slewed = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const HandFuzzFigures figures = play_random_hand(gpu, coarse(), seed, Seconds(4.0));
        EXPECT_EQ(figures.violation, "") << "again: eddy stability --hands 1 --seed " << seed;
        EXPECT_GT(figures.ticks, 1000);
        EXPECT_GT(figures.steps, 50);
        most_n = std::max(most_n, figures.most_n);
        reasons.insert(figures.reasons.begin(), figures.reasons.end());
        clamped += figures.gate.clamped;
        slewed += figures.gate.slewed;
    }
    // Else the fuzz would look into one corner only. Nobody presses stop, and no random hand is still for five seconds.
    EXPECT_EQ(reasons.size(), kGateSentences.size() - 2);
    EXPECT_GT(most_n, 0.5 * coarse().haptics.max_force_n);
    EXPECT_GT(clamped, 100u);
    EXPECT_GT(slewed, 100u);
}

TEST_F(HandFuzzTest, HeatThatASourceMakesIsNobodysFault) {
    const Scene scene = load_scene("everything", std::vector<std::string>{"tank.cells=[8, 8, 8]"}).scene;
    EXPECT_EQ(play_random_hand(gpu, scene, 1, Seconds(1.0)).violation, "");
}

TEST_F(HandFuzzTest, TheSameSeedIsTheSameHand) {
    const HandFuzzFigures once = play_random_hand(gpu, coarse(), 3, Seconds(1.0)),
                          again = play_random_hand(gpu, coarse(), 3, Seconds(1.0));
    EXPECT_EQ(once.most_n, again.most_n);
    EXPECT_EQ(once.ticks, again.ticks);
}

TEST(RandomHand, DoesEverythingAHandOrADeviceCanDo) {
    RandomHand hand(1);
    bool nan = false, leap = false, silent = false, away = false, moves = false;
    glm::dvec3 last(0.0);
    for (int ms = 1; ms < 60000; ++ms) {
        const Instant now = ms * std::chrono::milliseconds(1);
        hand.poll(now);
        away |= hand.state() != HapticState::Ready;
        silent |= hand.state() == HapticState::Ready && hand.silence(now) > Seconds(0.02);
        const auto reading = hand.read();
        EXPECT_FALSE(hand.read()) << "handed out once";
        if (!reading) continue;
        const double way = glm::length(reading->position_m - last);
        nan |= std::isnan(way);
        leap |= way > 0.02;
        moves |= way > 0.0 && way < 1e-3;
        last = reading->position_m;
    }
    EXPECT_TRUE(nan && leap && silent && away && moves);
}

}  // namespace
}  // namespace eddy::stability
