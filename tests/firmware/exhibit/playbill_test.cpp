#include "firmware/exhibit/playbill.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

Scene tank(int cells, const std::string& title) {
    const std::string n = std::to_string(cells);
    return read_scene("title = \"" + title + "\"\n[tank]\ncells = [" + n + ", " + n + ", " + n +
                          "]\n[[body]]\nradius_m = 0.025\nmotion = \"held\"\n"
                          "[render]\nwidth_px = 32\nheight_px = 24\n",
                      "test.toml")
        .scene;
}

class PlaybillTest : public gles::GlTest {
  protected:
    HandSide nobody{nullptr, "none", {}, {}};
    Playbill playbill{gpu, nobody};

    Playbill::News finish() {
        for (;;)
            if (const auto news = playbill.work()) return *news;
    }
};

TEST_F(PlaybillTest, PlaysTheOldActUntilTheNewOneIsReady) {
    playbill.announce(tank(8, "first"), {});
    EXPECT_FALSE(playbill.plays());
    EXPECT_TRUE(finish().began);
    playbill.announce(tank(10, "second"), {});
    playbill.act().go_on(20ms, 20ms);
    EXPECT_FALSE(playbill.work()) << "the fluid is made in pieces";
    EXPECT_EQ(playbill.act().scene().title, "first");
    playbill.act().go_on(40ms, 20ms);
    const Playbill::News news = finish();
    EXPECT_TRUE(news.began);
    EXPECT_GT(news.prepared.count(), 0.0);
    EXPECT_EQ(playbill.act().scene().title, "second");
    EXPECT_FALSE(playbill.something_announced());
    EXPECT_FALSE(playbill.work());
}

TEST_F(PlaybillTest, StaysWithTheOldActIfTheNewOneCannotBeMade) {
    playbill.announce(tank(8, "first"), {});
    finish();
    Scene scene = tank(8, "second");
    scene.initial.velocity_npy = "/no/such/file.npy";
    playbill.announce(scene, {});
    const Playbill::News news = finish();
    EXPECT_FALSE(news.began);
    EXPECT_THAT(news.failed, HasSubstr("/no/such/file.npy"));
    EXPECT_EQ(playbill.act().scene().title, "first");
    playbill.act().go_on(20ms, 20ms);
}

TEST_F(PlaybillTest, ForgetsAnActThatAnotherOvertakes) {
    playbill.announce(tank(8, "first"), {});
    playbill.work();
    playbill.announce(tank(8, "second"), {});
    finish();
    EXPECT_EQ(playbill.act().scene().title, "second");
    EXPECT_FALSE(playbill.work());
}

TEST_F(PlaybillTest, PausesBeforeEachShaderProgramThatAnActNeeds) {
    playbill.announce(tank(9, "first"), {});
    std::size_t linked = gpu.programs().linked(), most = 0;
    const std::size_t before = linked;
    std::vector<double> prepared;
    const auto meanwhile = [&] {
        most = std::max(most, gpu.programs().linked() - linked);
        linked = gpu.programs().linked();
        prepared.push_back(playbill.prepared());
        return true;
    };
    while (!playbill.work(meanwhile)) {
    }
    EXPECT_TRUE(playbill.plays());
    EXPECT_GT(linked, before + 10) << "a grid that no test had before";
    EXPECT_EQ(most, 1u);
    EXPECT_EQ(prepared.front(), 0.0);
    EXPECT_GT(prepared.back(), 0.5);
    EXPECT_TRUE(std::is_sorted(prepared.begin(), prepared.end()));
    const std::size_t pauses = prepared.size();
    playbill.act().go_on(20ms, 20ms);
    EXPECT_EQ(prepared.size(), pauses) << "none in the show";
}

TEST_F(PlaybillTest, GivesAnActUpInTheMiddleAndBeginsItAnew) {
    int all = 0;
    playbill.announce(tank(11, "first"), {});
    while (!playbill.work([&] { return ++all > 0; })) {
    }
    for (const int after : {3, all - 3}) {  // in the middle of making it, and of preparing it
        playbill.announce(tank(11, "again"), {});
        int pauses = 0;
        const auto meanwhile = [&] { return ++pauses < after; };
        while (pauses < after) ASSERT_FALSE(playbill.work(meanwhile)) << after;
        EXPECT_EQ(playbill.prepared(), 0.0);
        EXPECT_TRUE(playbill.something_announced());
        EXPECT_TRUE(finish().began);
        EXPECT_EQ(playbill.act().scene().title, "again");
        playbill.act().go_on(20ms, 20ms);
    }
}

TEST_F(PlaybillTest, KeepsNoTextureOfActsThatHavePlayed) {
    playbill.announce(tank(8, "first"), {});
    finish();
    playbill.act().go_on(20ms, 20ms);
    std::int64_t bytes = 0;
    for (int n = 0; n < 3; ++n) {
        playbill.announce(tank(12, "again"), {});
        finish();
        playbill.act().go_on(20ms, 20ms);
        if (n == 0) bytes = gpu.textures().bytes();
    }
    EXPECT_EQ(gpu.textures().bytes(), bytes);
}

}  // namespace
}  // namespace eddy
