#include "gles/gpu_timer.h"

#include <cmath>

#include "gles/texture.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using GpuTimerTest = GlTest;

TEST_F(GpuTimerTest, TellsATimeForEachQuestion) {
    if (!gpu.capabilities().timer_query)
        GTEST_SKIP() << "skipped: this driver lacks EXT_disjoint_timer_query";
    GpuTimer timer;
    const std::vector<float> texels(256 * 256 * 4, 1.0f);
    Texture texture({256, 256}, Format::RGBA32F, false);
    for (int i = 0; i < 3; ++i) {
        timer.begin();
        texture.upload(texels.data());
        timer.end();
        const std::optional<double> ms = timer.milliseconds();
        if (!ms) continue;  // disturbed
        EXPECT_TRUE(std::isfinite(*ms));
        EXPECT_GE(*ms, 0.0);
    }
}

}  // namespace
}  // namespace eddy::gles
