#include "firmware/exhibit/playbill.h"

#include <gmock/gmock.h>

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
