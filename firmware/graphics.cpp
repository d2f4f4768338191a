#include "firmware/graphics.h"

#include <fmt/format.h>

namespace eddy {

std::unique_ptr<Graphics> open_headless() {
    std::unique_ptr<Display> display = make_headless_display();
    const bool on_gpu = display->native_display() != nullptr;
    try {
        return std::make_unique<Graphics>(std::move(display));
    } catch (const gles::GlError& e) {
        if (!on_gpu) throw;
        fmt::print(stderr, "the GPU cannot be used ({}); drawing in software instead\n", e.what());
        return std::make_unique<Graphics>(make_software_display());
    }
}

}  // namespace eddy
