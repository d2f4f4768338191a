#include <GLES3/gl3.h>
#include <dlfcn.h>

#include "gles/readback.h"
#include "tests/gles/gl_fixture.h"

// A GPU that takes its time. This program stands between gles/gpu and the driver: its fences do not pass before so many looks.

namespace {

int g_looks_left = 0;

}  // namespace

extern "C" GLenum glClientWaitSync(GLsync fence, GLbitfield flags, GLuint64 timeout_ns) {
    static auto* const driver =
        reinterpret_cast<GLenum (*)(GLsync, GLbitfield, GLuint64)>(dlsym(RTLD_NEXT, "glClientWaitSync"));
    if (g_looks_left > 0 && g_looks_left-- > 0) return GL_TIMEOUT_EXPIRED;
    return driver(fence, flags, timeout_ns);
}

namespace eddy::gles {
namespace {

class GpuWait : public GlTest {
  protected:
    GpuWait() {
        gpu.on_pause([this](Next next) {
            ++pauses;
            EXPECT_EQ(next, Next::Work);
            if (gives_up) throw 1;
        });
    }
    ~GpuWait() override {
        g_looks_left = 0;
        gpu.on_pause({});
    }
    int pauses = 0;
    bool gives_up = false;
};

TEST_F(GpuWait, LeavesWhoeverWaitsAPauseEachTenthOfASecond) {
    gpu.finish();
    EXPECT_EQ(pauses, 0);
    g_looks_left = 100;  // ten seconds
    gpu.finish();
    EXPECT_EQ(pauses, 100);
}

TEST_F(GpuWait, CanBeGivenUp) {
    gives_up = true;
    g_looks_left = 100;
    EXPECT_THROW(gpu.finish(), int);
    EXPECT_EQ(pauses, 1);
}

TEST_F(GpuWait, IsLongOnlyWhereTheDriverMayCompile) {
    gpu.on_pause({});
    gpu.finish();
    EXPECT_EQ(gpu.patience(), std::chrono::seconds(10));
    gpu.pause();
    EXPECT_EQ(gpu.patience(), std::chrono::seconds(10));
    gpu.pause(Next::Compiling);
    EXPECT_EQ(gpu.patience(), std::chrono::seconds(120));
    gpu.finish();
    EXPECT_EQ(gpu.patience(), std::chrono::seconds(10));
}

TEST_F(GpuWait, OfAReadbackHasThemToo) {
    const TexturePool::Lease texture = gpu.textures().lease({1, 1}, Format::RGBA32F);
    Readback readback(gpu, {1, 1});
    for (long n = 0; n < 3; ++n) readback.request(*texture, n);
    g_looks_left = 5;
    EXPECT_FALSE(readback.take(false));
    EXPECT_EQ(pauses, 0) << "it does not wait";
    readback.request(*texture, 3);  // waits for the first
    EXPECT_EQ(pauses, 4);
    gives_up = true;
    g_looks_left = 5;
    EXPECT_THROW(readback.take(true), int);
    EXPECT_EQ(readback.under_way(), 3) << "nothing is lost by that";
    EXPECT_EQ(readback.failures(), 0U);
}

TEST_F(GpuWait, EndsWhenItsPatienceDoes) {
    g_looks_left = 1'000'000;
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    EXPECT_FALSE(gpu.wait(fence, std::chrono::milliseconds(20)));
    g_looks_left = 0;
    EXPECT_TRUE(gpu.wait(fence, std::chrono::seconds(10)));
    glDeleteSync(fence);
}

}  // namespace
}  // namespace eddy::gles
