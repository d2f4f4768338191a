#include "gles/context.h"

#include <GLES3/gl3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "hal/display/display.h"

namespace eddy::gles {
namespace {

/// Its own context: there is one display in a process, and who takes it down takes it from all.
class ContextTest : public testing::Test {
  protected:
    std::unique_ptr<Display> display = make_software_display();
    Context context{{display->egl_platform(), display->native_display()}};

    /// Fills the window with a grey, and says what is in it then, in the middle.
    static int draw_and_read(float grey, int width, int height) {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glClearColor(grey, grey, grey, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        unsigned char pixel[4]{};
        glReadPixels(width / 2, height / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        return pixel[0];
    }
};

TEST_F(ContextTest, BeginsWithoutAWindow) {
    EXPECT_FALSE(context.has_window());
    EXPECT_TRUE(context.swap()) << "nothing to show is no failure";
    EXPECT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_UNDEFINED));
}

TEST_F(ContextTest, WindowsComeAndGoAndTexturesStay) {
    unsigned texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, 4, 4);
    for (int i = 0; i < 20; ++i) {
        const int width = 64 + 8 * i, height = 48 + 4 * i;
        context.set_window({nullptr, width, height});
        EXPECT_TRUE(context.has_window());
        EXPECT_EQ(draw_and_read(0.2f, width, height), 51);
        EXPECT_TRUE(context.swap());
        if (i % 3 == 0) context.take_window_away();
    }
    EXPECT_TRUE(glIsTexture(texture));
    context.take_window_away();
    EXPECT_FALSE(context.has_window());
}

TEST_F(ContextTest, AWindowThatCannotBeIsRefusedAndTheContextLivesOn) {
    EXPECT_THROW(context.set_window({nullptr, -1, 100}), GlError);
    EXPECT_FALSE(context.has_window());
    context.set_window({nullptr, 32, 32});
    EXPECT_EQ(draw_and_read(1.0f, 32, 32), 255);
}

TEST_F(ContextTest, TellsOfResetsWhereTheDriverDoes) {
    // Mesa's interpreter has no such contexts, its rasteriser has: one of these is what this program was started on.
    const bool interpreter = context.capabilities().renderer.find("softpipe") != std::string::npos;
    EXPECT_EQ(context.capabilities().tells_of_resets, !interpreter) << context.capabilities().renderer;
    EXPECT_EQ(context.reset_status(), ResetStatus::None);
}

TEST(ResetStatus, NumbersThatMustNotBeAreNoise) {
    EXPECT_EQ(reset_status_from(0x8253), ResetStatus::Guilty);
    EXPECT_EQ(reset_status_from(0x8254), ResetStatus::Innocent);
    EXPECT_EQ(reset_status_from(0x8255), ResetStatus::Unknown);
    for (const unsigned noise : {0U, 1U, 0x8252U, 0x8256U, 0x0500U, 0xffffffffU})
        EXPECT_EQ(reset_status_from(noise), ResetStatus::None) << noise;
}

}  // namespace
}  // namespace eddy::gles
