#pragma once
#include <memory>

#include "gles/context.h"
#include "gles/gpu.h"
#include "hal/display/display.h"

namespace eddy {

/// A display, a GL context on it and the GPU's state, brought up in this order and taken down in reverse.
/// Throws gles::GlError with what to try.
struct Graphics {
    explicit Graphics(std::unique_ptr<Display> display_)
        : display(std::move(display_)),
          context({display->egl_platform(), display->native_display(), display->native_window()}),
          gpu(context.capabilities()) {}

    /// The processor does the drawing.
    bool in_software() const { return display->native_display() == nullptr; }

    std::unique_ptr<Display> display;
    gles::Context context;
    gles::Gpu gpu;
};

/// Graphics without a screen: on the GPU if there is one that can be opened, else in software, which it says on
/// standard error. Throws gles::GlError if neither works.
std::unique_ptr<Graphics> open_headless();

}  // namespace eddy
