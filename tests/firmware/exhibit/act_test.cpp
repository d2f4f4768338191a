#include "firmware/exhibit/act.h"

#include <algorithm>
#include <vector>

#include "firmware/exhibit/hand_side.h"
#include "hal/haptic/emulated/make_emulated_falcon.h"
#include "hal/haptic/emulated/person_motion.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

Scene tank(const std::string& density_kg_m3) {
    return read_scene("[tank]\ncells = [16, 16, 16]\n[fluid]\ndensity_kg_m3 = " + density_kg_m3 +
                          "\n[[body]]\nradius_m = 0.025\nmotion = \"held\"\n"
                          "[haptics]\ngain = 20\n[render]\nwidth_px = 32\nheight_px = 24\n",
                      "test.toml")
        .scene;
}

std::unique_ptr<HapticDevice> person() {
    emulated::EmulatedFalconSettings settings;
    return emulated::make_emulated_falcon(
        std::make_unique<emulated::PersonMotion>(emulated::PersonSettings{}), settings);
}

/// A handle that nobody moves.
class Still final : public emulated::HandMotion {
  public:
    glm::dvec3 position_m(Seconds) const override { return glm::dvec3(0.0); }
};

std::unique_ptr<HapticDevice> still_hand() {
    emulated::EmulatedFalconSettings settings;
    settings.plant.hand = emulated::Hand::OnPath;
    return emulated::make_emulated_falcon(std::make_unique<Still>(), settings);
}

void make_ready(Act& act) {
    while (act.prepare()) {
    }
}

/// Acts on virtual time, with a person at an emulated Falcon.
class ActTest : public gles::GlTest {
  protected:
    explicit ActTest(std::unique_ptr<HapticDevice> device = person())
        : hand(std::move(device), "emulated", {}, {}) {}

    HandSide hand;
    Instant now{0};
    std::vector<TickRecord> ticks;

    Act act(const std::string& density_kg_m3) { return {gpu, tank(density_kg_m3), hand.exchange(), {}}; }

    void play(Act& act, Instant how_long, Instant period = 20ms) {
        ticks.clear();
        for (const Instant end = now + how_long; now < end; now += kTick) {
            hand.tick(now);
            if (now % period != Instant(0)) continue;
            act.publish(act.show().figures().steps > 0);
            act.go_on(now, period);
            hand.follow([&](auto part) { ticks.insert(ticks.end(), part.begin(), part.end()); });
        }
    }
    double most_n() const {
        double most = 0.0;
        for (const TickRecord& tick : ticks) most = std::max(most, glm::length(tick.sent_force_n));
        return most;
    }
    /// In newtons a tick, upwards only: towards zero the gate may leap.
    double steepest_rise_n() const {
        double steepest = 0.0;
        for (std::size_t i = 1; i < ticks.size(); ++i)
            steepest = std::max(steepest,
                                glm::length(ticks[i].sent_force_n) - glm::length(ticks[i - 1].sent_force_n));
        return steepest;
    }
};

TEST_F(ActTest, GivesNoForceBeforeItsFluidHasAnswered) {
    Act first = act("1000");
    make_ready(first);
    EXPECT_FALSE(hand.exchange().orders.newest().enabled);
    first.begin(hand.orders());
    EXPECT_FALSE(hand.exchange().orders.newest().enabled);
    play(first, 100ms);
    EXPECT_TRUE(hand.exchange().orders.newest().enabled);
    first.reset();
    EXPECT_FALSE(hand.exchange().orders.newest().enabled);
    play(first, 100ms);
    EXPECT_TRUE(hand.exchange().orders.newest().enabled);
}

TEST_F(ActTest, ABodyIsMovedHoweverSlowTheMachineIsAndHoweverLongTheScenesSteps) {
    for (const Instant period : {200ms, 300ms}) {
        Scene scene = tank("1000");
        if (period == 300ms) scene.solver.dt_s = 0.3;
        Act act(gpu, scene, hand.exchange(), {});
        make_ready(act);
        act.begin(hand.orders());
        play(act, 1800ms, period);
        int moves = 0;
        for (int n = 0; n < 10; ++n) {
            play(act, period, period);
            moves += glm::length(act.show().bodies().front().velocity_m_s) > 0.0;
        }
        EXPECT_EQ(moves, 10) << period / 1ms << " ms";
        EXPECT_EQ(act.show().guards().step_shortened, 0) << "the fluid takes the steps that the body takes";
    }
}

class StillActTest : public ActTest {
  protected:
    StillActTest() : ActTest(still_hand()) {}
};

TEST_F(StillActTest, AResetWhileTheShowRestsTakesTheForceAwayForAMomentOnly) {
    Act act = this->act("1000");
    make_ready(act);
    act.begin(hand.orders());
    play(act, 7s);
    ASSERT_GT(act.show().figures().rested, 0);
    act.reset();
    EXPECT_FALSE(hand.exchange().orders.newest().enabled);
    play(act, 200ms);
    EXPECT_TRUE(hand.exchange().orders.newest().enabled);
}

TEST_F(ActTest, IsMadeReadyWhileAnotherPlaysWithoutItsNotice) {
    Act first = act("1000");
    make_ready(first);
    first.begin(hand.orders());
    play(first, 2s);
    const HapticOrders before = hand.exchange().orders.newest();
    const std::uint64_t answers = first.show().answers();
    Act next = act("500");
    int pieces = 1;
    while (next.prepare()) ++pieces;
    EXPECT_GE(pieces, 3) << "so that the other can go on in between";
    EXPECT_EQ(hand.exchange().orders.newest().gain, before.gain);
    EXPECT_TRUE(hand.exchange().orders.newest().enabled);
    EXPECT_EQ(hand.exchange().fluid.newest().sequence, answers) << "its fluid answers nobody yet";
}

TEST_F(ActTest, TakesOverFromTheOneBeforeWithoutABlowToTheHand) {
    Act first = act("1000");
    make_ready(first);
    first.begin(hand.orders());
    play(first, 8s);
    ASSERT_GT(most_n(), 0.05) << "there is something to feel";
    const std::uint64_t answers = first.show().answers();

    Act next = act("3000");
    make_ready(next);
    next.begin(hand.orders(), &first);
    const double before_n = glm::length(ticks.back().sent_force_n);
    play(next, 4s);
    EXPECT_GT(next.show().answers(), answers) << "counted on, or the loop would take new answers for old";
    EXPECT_LE(glm::length(ticks.front().sent_force_n), before_n + 1e-9);
    EXPECT_LE(steepest_rise_n(), 0.1 + 1e-9) << "the gate's slew limit";
    EXPECT_TRUE(std::any_of(ticks.begin(), ticks.end(), [](const TickRecord& t) {
        return t.reason == GateReason::Disabled;
    })) << "off while no answer is the new fluid's";
    EXPECT_TRUE(std::any_of(ticks.begin(), ticks.end(), [](const TickRecord& t) {
        return t.reason == GateReason::Starting;
    })) << "and brought in gently";
    EXPECT_EQ(ticks.back().reason, GateReason::Open);
    EXPECT_GT(most_n(), 0.05);
}

TEST_F(ActTest, WithoutAHandOrAPictureMakesReadyNeither) {
    const Scene scene = tank("1000");
    Act watched(gpu, scene, hand.exchange(), {});
    Act blind(gpu, scene, hand.exchange(), {.has_picture = false, .has_hand = false});
    int watched_pieces = 1, blind_pieces = 1;
    while (watched.prepare()) ++watched_pieces;
    while (blind.prepare()) ++blind_pieces;
    EXPECT_LT(blind_pieces, watched_pieces);
}

}  // namespace
}  // namespace eddy
