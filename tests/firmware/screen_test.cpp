#include "firmware/screen.h"

#include <GLES3/gl3.h>
#include <gmock/gmock.h>

#include "firmware/text_file.h"
#include "hal/display/emulated/emulated_machine.h"
#include "hal/display/kms/kms_display.h"
#include "tests/gles/render/rig.h"
#include "tests/scratch_folder.h"

// The show's own renderer, through a real context and the real display, onto an emulated screen.

namespace eddy {
namespace {

using namespace std::chrono_literals;
using emulated::make_edid;
using emulated::make_mode;
using kms::Connection;
using testing::HasSubstr;

class ScreenTest : public testing::Test {
  protected:
    static constexpr int kWidth = 160, kHeight = 90;

    void SetUp() override { plug().modes = {make_mode(kWidth, kHeight, 60.0, true)}; }
    emulated::Plug& plug() { return machine.card().plugs[0]; }

    void open() {
        graphics =
            std::make_unique<Graphics>(std::make_unique<kms::KmsDisplay>(machine.machine(), kms::Wish{}));
        start();
    }
    void start() {
        screen.emplace(*graphics, screen_memory(folder.path()));
        gles::RenderSetup setup;
        setup.width_px = 64;
        setup.height_px = 36;
        fluid.emplace(graphics->gpu, gles::tank(true, true), gles::cloud({12, 10, 11}, 8.0f));
        renderer.emplace(graphics->gpu, gles::tank(true, true), setup);
    }
    void close() {
        renderer.reset();
        fluid.reset();
        screen.reset();
    }
    void TearDown() override {
        close();
        graphics.reset();
        EXPECT_EQ(machine.card().commits_too_early, 0);
    }
    DisplayState turn() {
        machine.wait(16667us);
        const DisplayState state = screen->poll(machine.now());
        if (screen->wants_picture()) {
            renderer->draw(*fluid, {gles::ball_at({12, 10, 11})});
            screen->show(renderer->picture());
        }
        return state;
    }
    DisplayState run(Instant time) {
        DisplayState state{};
        for (const Instant end = machine.now() + time; machine.now() < end;) state = turn();
        return state;
    }
    /// What is in the window, as Renderer::rgb() has it.
    static gles::Picture window(int width, int height) {
        std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(width * height));
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        gles::Picture p{width, height, {}};
        for (int y = height - 1; y >= 0; --y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c)
                    p.rgb.push_back(
                        rgba[4 * static_cast<std::size_t>(y * width + x) + static_cast<std::size_t>(c)]);
        return p;
    }

    emulated::ScreenMachine machine;
    const ScratchFolder folder;
    std::unique_ptr<Graphics> graphics;
    std::optional<Screen> screen;
    std::optional<gles::StillSmoke> fluid;
    std::optional<gles::Renderer> renderer;
};

TEST_F(ScreenTest, ShowsTheRenderersPictureAsLargeAsTheScreen) {
    open();
    EXPECT_EQ(run(500ms), DisplayState::Showing);
    EXPECT_EQ(screen->size_px(), (SizePx{kWidth, kHeight}));
    EXPECT_GT(screen->shown(), 20);
    const gles::Picture drawn{64, 36, renderer->rgb()}, seen = window(kWidth, kHeight);
    // Two and a half times as large: its middle, a corner, and somewhere else.
    for (const glm::ivec2 at : {glm::ivec2(32, 18), glm::ivec2(2, 2), glm::ivec2(20, 26)})
        EXPECT_LT(glm::distance(drawn.pixel(at.x, at.y), seen.pixel(at.x * 5 / 2 + 1, at.y * 5 / 2 + 1)),
                  12.0)
            << at.x << ", " << at.y;
    EXPECT_GT(glm::distance(seen.pixel(kWidth / 2, kHeight / 2), seen.pixel(2, 2)), 50.0)
        << "something is to be seen";
}

TEST_F(ScreenTest, AMonitorOfAnotherSizeGetsAnotherWindow) {
    open();
    run(500ms);
    plug().edid = make_edid("Hall 2");
    plug().modes = {make_mode(96, 96, 60.0, true)};
    machine.tell_of_plugs();
    EXPECT_EQ(run(1s), DisplayState::Showing);
    EXPECT_EQ(screen->size_px(), (SizePx{96, 96}));
    const gles::Picture seen = window(96, 96);
    EXPECT_EQ(seen.pixel(48, 2), glm::dvec3(0.0)) << "black above a picture that is wider";
    EXPECT_GT(glm::length(seen.pixel(48, 48)), 50.0);
}

TEST_F(ScreenTest, WithoutAMonitorTheShowGoesOnAndComesBackWithIt) {
    plug().connection = Connection::Disconnected;
    open();
    EXPECT_EQ(run(1s), DisplayState::NoMonitor);
    EXPECT_FALSE(screen->wants_picture());
    EXPECT_FALSE(screen->show(renderer->picture())) << "and no harm is done";
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    plug().connection = Connection::Connected;
    machine.tell_of_plugs();
    EXPECT_EQ(run(1s), DisplayState::Showing);
    EXPECT_GT(screen->shown(), 10);
}

TEST_F(ScreenTest, ClosedDrawsNothing) {
    open();
    run(200ms);
    screen->set_awake(false);
    run(200ms);
    const long before = screen->shown();
    EXPECT_EQ(run(2s), DisplayState::Asleep);
    EXPECT_EQ(screen->shown(), before);
    screen->set_awake(true);
    EXPECT_EQ(run(1s), DisplayState::Showing);
    EXPECT_GT(screen->shown(), before);
}

TEST_F(ScreenTest, OutlivesAContextThatIsMadeAgain) {
    open();
    run(500ms);
    close();
    graphics = open_again(std::move(graphics));
    start();
    const long flips = graphics->display->counters().flips;
    EXPECT_EQ(run(500ms), DisplayState::Showing);
    EXPECT_GT(graphics->display->counters().flips, flips + 20);
    EXPECT_GT(glm::length(window(kWidth, kHeight).pixel(kWidth / 2, kHeight / 2)), 50.0);
}

TEST_F(ScreenTest, SaysWhatIsNewOnceAndRemembersTheScreen) {
    open();
    run(200ms);
    const auto news = screen->news();
    ASSERT_TRUE(news);
    EXPECT_EQ(news->state, DisplayState::Showing);
    EXPECT_THAT(news->text, AllOf(HasSubstr("showing"), HasSubstr("Hall 1")));
    EXPECT_FALSE(screen->news());
    EXPECT_EQ(last_screen(folder.path()), graphics->display->screen_id());
    plug().connection = Connection::Disconnected;
    machine.tell_of_plugs();
    run(1s);
    const auto loss = screen->news();
    ASSERT_TRUE(loss);
    EXPECT_EQ(loss->state, DisplayState::NoMonitor);
    EXPECT_THAT(loss->text, HasSubstr("no monitor: no screen is connected"));
}

TEST_F(ScreenTest, ADisplayThatGivesUpAsksForARestart) {
    open();
    run(200ms);
    machine.card().loses_flips = true;
    EXPECT_EQ(run(10s), DisplayState::Lost);
    EXPECT_FALSE(screen->wants_picture());
}

TEST(PictureSize, IsOfTheScreensShapeAndNoLargerThanItMayBe) {
    EXPECT_EQ(picture_size({1920, 1080}, 0), (SizePx{1920, 1080}));
    EXPECT_EQ(picture_size({1920, 1080}, 921600), (SizePx{1280, 720}));
    EXPECT_EQ(picture_size({640, 480}, 921600), (SizePx{640, 480}));
    EXPECT_EQ(picture_size({1080, 1920}, 921600), (SizePx{720, 1280}));
    const SizePx odd = picture_size({1366, 768}, 300000);
    EXPECT_LE(odd.width * odd.height, 300000);
    EXPECT_NEAR(static_cast<double>(odd.width) / odd.height, 1366.0 / 768.0, 0.01);
    EXPECT_EQ(picture_size({1, 1}, 1), (SizePx{2, 2}));
}

}  // namespace
}  // namespace eddy
