#include "firmware/exhibit/front.h"

#include <EGL/egl.h>
#include <dlfcn.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "firmware/exhibit/office.h"
#include "hal/haptic/emulated/make_emulated_falcon.h"
#include "hal/haptic/emulated/person_motion.h"

// A GPU that is reset. This program stands between gles/context and the driver: it hands out its own function for what became of the
// context, and passes everything else on.

namespace {

constexpr unsigned kGuilty = 0x8253;
/// What the next calls find; 0: nothing happened.
int g_lost_for = 0;

unsigned reset_status() {
    return g_lost_for > 0 && g_lost_for-- > 0 ? kGuilty : 0U;
}

}  // namespace

extern "C" __eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
    using Function = __eglMustCastToProperFunctionPointerType;
    static auto* const driver =
        reinterpret_cast<Function (*)(const char*)>(dlsym(RTLD_NEXT, "eglGetProcAddress"));
    if (std::strncmp(name, "glGetGraphicsResetStatus", 24) == 0)
        return reinterpret_cast<Function>(&reset_status);
    return driver(name);
}

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

Scene held_ball(const std::string& title) {
    return read_scene("title = \"" + title +
                          "\"\n[tank]\ncells = [16, 16, 16]\n[fluid]\ndensity_kg_m3 = "
                          "1000\n[[body]]\nradius_m = 0.025\nmotion = "
                          "\"held\"\n[haptics]\ngain = 20\n[render]\nwidth_px = 32\nheight_px = 24\n",
                      "test.toml")
        .scene;
}
Scene impossible() {
    Scene scene = held_ball("impossible");
    scene.initial.velocity_npy = "/no/such/file.npy";
    return scene;
}

/// On virtual time, with a person at an emulated Falcon.
class FrontTest : public testing::Test {
  protected:
    void SetUp() override {
        g_lost_for = 0;
        if (!front.graphics().context.capabilities().tells_of_resets)
            GTEST_SKIP() << "skipped: this driver makes no contexts that tell of resets";
    }

    static std::unique_ptr<HapticDevice> person() {
        return emulated::make_emulated_falcon(
            std::make_unique<emulated::PersonMotion>(emulated::PersonSettings{}), {});
    }
    void pass(Instant time) {
        ticks.clear();
        for (const Instant end = now + time; now < end; now += kTick) {
            hand.tick(now);
            if ((now / kTick) % 20 != 0) continue;
            if (front.plays()) {
                front.act().publish(front.act().show().figures().steps > 0);
                front.act().go_on(now, 20ms);
            }
            hand.follow([this](auto part) { ticks.insert(ticks.end(), part.begin(), part.end()); });
        }
        hand.follow([this](auto part) { ticks.insert(ticks.end(), part.begin(), part.end()); });
    }
    Playbill::News finish() {
        for (;;) {
            if (const auto news = front.prepare()) return *news;
            pass(20ms);
        }
    }
    void play(const Scene& scene) {
        front.announce(scene, {});
        ASSERT_TRUE(finish().began);
    }
    std::vector<double> sent_n() const {
        std::vector<double> sent;
        for (const TickRecord& tick : ticks) sent.push_back(glm::length(tick.sent_force_n));
        return sent;
    }

    HandSide hand{person(), "emulated", {}, {}};
    Front front{std::make_unique<Graphics>(make_headless_display()), hand, {}, 0};
    Instant now{0};
    std::vector<TickRecord> ticks;
};

TEST_F(FrontTest, MakesTheActAnewAfterAResetOfTheGpu) {
    play(held_ball("first"));
    front.poll(now);
    EXPECT_EQ(front.gpu_resets(), 0U);
    EXPECT_TRUE(front.plays());
    g_lost_for = 3;  // the driver needs a moment
    front.poll(now);
    EXPECT_EQ(front.gpu_resets(), 1U);
    EXPECT_FALSE(front.plays()) << "it went with the textures";
    EXPECT_TRUE(front.preparing()) << "but is announced anew";
    front.show_words({"One moment"}, now);
    EXPECT_TRUE(finish().began);
    EXPECT_EQ(front.act().scene().title, "first");
    front.show_act(now, "");
    pass(100ms);
    EXPECT_GT(front.act().show().answers(), 0U);
}

TEST_F(FrontTest, IsToldInTheLogOnceForEachReset) {
    const RealClock clock;
    Office office(clock);
    play(held_ball("first"));
    const auto told = [&] {
        testing::internal::CaptureStderr();
        office.tell_news(front, hand);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(told(), Not(HasSubstr("GPU")));
    g_lost_for = 1;
    front.poll(now);
    EXPECT_THAT(told(), HasSubstr("the GPU was reset"));
    EXPECT_THAT(told(), Not(HasSubstr("GPU")));
}

TEST_F(FrontTest, TakesTheForceAwayWhileTheHandsSideLivesOn) {
    play(held_ball("first"));
    pass(8s);
    const std::vector<double> before = sent_n();
    ASSERT_GT(*std::max_element(before.begin(), before.end()), 0.05) << "there is something to feel";
    const std::uint64_t loop_ticks = hand.report().ticks;

    g_lost_for = 1;
    front.poll(now);
    pass(500ms);
    EXPECT_EQ(hand.report().ticks, loop_ticks + 500);
    EXPECT_EQ(hand.report().device, HapticState::Ready);
    EXPECT_EQ(ticks.back().reason, GateReason::Disabled);
    const std::vector<double> meanwhile = sent_n();
    EXPECT_LE(meanwhile.front(), before.back() + 1e-9);
    EXPECT_TRUE(std::is_sorted(meanwhile.rbegin(), meanwhile.rend())) << "it only falls";
    EXPECT_EQ(meanwhile.back(), 0.0);

    ASSERT_TRUE(finish().began);
    EXPECT_THAT(sent_n(), Each(0.0)) << "until the new fluid has answered";
    pass(4s);
    const std::vector<double> after = sent_n();
    EXPECT_GT(*std::max_element(after.begin(), after.end()), 0.05);
    for (std::size_t i = 1; i < after.size(); ++i)
        ASSERT_LE(after[i] - after[i - 1], 0.1 + 1e-9) << "the gate's slew limit, at tick " << i;
}

TEST_F(FrontTest, BeginsAnewWhatWasBeingPreparedWhenTheGpuWasReset) {
    front.announce(held_ball("first"), {});
    int pauses = 0;
    const auto news = front.prepare([&] {
        if (++pauses == 5) g_lost_for = 2;
        return front.wait({"Eddy is starting"}, now);
    });
    EXPECT_FALSE(news) << "given up";
    EXPECT_EQ(pauses, 5);
    EXPECT_TRUE(front.has_shown_words());
    front.poll(now);
    EXPECT_EQ(front.gpu_resets(), 1U);
    EXPECT_TRUE(finish().began);
    EXPECT_EQ(front.act().scene().title, "first");
}

TEST_F(FrontTest, ReturnsToTheActThatPlayedIfTheNextOneCannotBeMade) {
    play(held_ball("first"));
    front.announce(impossible(), {});
    EXPECT_FALSE(finish().began);
    g_lost_for = 1;
    front.poll(now);
    EXPECT_TRUE(finish().began) << "not the one that failed";
    EXPECT_EQ(front.act().scene().title, "first");

    front.announce(impossible(), {});
    g_lost_for = 1;
    front.poll(now);
    const Playbill::News news = finish();
    EXPECT_FALSE(news.began);
    EXPECT_THAT(news.failed, HasSubstr("/no/such/file.npy"));
    EXPECT_TRUE(finish().began);
    EXPECT_EQ(front.act().scene().title, "first");
}

TEST_F(FrontTest, EndsTheProgramIfTheDriverDoesNotComeBack) {
    play(held_ball("first"));
    g_lost_for = std::numeric_limits<int>::max();
    EXPECT_THROW(front.poll(now), gles::GlError);
}

}  // namespace
}  // namespace eddy
