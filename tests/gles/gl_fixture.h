#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "gles/context.h"
#include "gles/gpu.h"
#include "hal/display/display.h"

namespace eddy::gles {

/// One GL context for the whole test program, on whatever this machine has: a GPU without a screen, or the
/// rasteriser.
inline Gpu& shared_gpu() {
    struct Machine {
        std::unique_ptr<Display> display = make_headless_display();
        Context context{{display->egl_platform(), display->native_display()}};
        Gpu gpu{context.capabilities()};
    };
    static Machine machine;
    return machine.gpu;
}

class GlTest : public testing::Test {
  protected:
    Gpu& gpu = shared_gpu();
};

}  // namespace eddy::gles
