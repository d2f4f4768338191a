#include "firmware/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "firmware/text_file.h"
#include "gles/render/window.h"

namespace eddy {
namespace {

/// More kinds of windows than any display tries.
constexpr int kKinds = 100;

}  // namespace

SizePx picture_size(const SizePx& window, long max_pixels) {
    const double pixels = static_cast<double>(window.width) * window.height;
    const double scale = max_pixels > 0 && pixels > static_cast<double>(max_pixels)
                             ? std::sqrt(static_cast<double>(max_pixels) / pixels)
                             : 1.0;
    const auto even = [](double x) { return std::max(2, static_cast<int>(x / 2.0 + 1e-9) * 2); };
    return {even(window.width * scale), even(window.height * scale)};
}

Screen::Screen(Graphics& graphics, std::filesystem::path memory)
    : graphics_(graphics), memory_(std::move(memory)) {
    follow_window();
}

DisplayState Screen::poll(Instant now) {
    if (graphics_.context.reset_status() != gles::ResetStatus::None) graphics_lost_ = true;
    state_ = graphics_.display->poll(now);
    follow_window();
    remember();
    return state_;
}

void Screen::follow_window() {
    Display& display = *graphics_.display;
    for (int i = 0; i < kKinds && window_ != display.window_number(); ++i) {
        window_ = display.window_number();
        const std::optional<SizePx> size = display.size_px();
        graphics_.context.take_window_away();
        if (!size) return;
        try {
            graphics_.context.set_window({display.native_window(), size->width, size->height});
        } catch (const gles::GlError& e) {
            fmt::print(stderr, "screen: {}\n", e.what());
            display.refuse_window();
        }
    }
}

bool Screen::wants_picture() const {
    return !graphics_lost_ && graphics_.context.has_window() && graphics_.display->wants_frame();
}

std::optional<SizePx> Screen::size_px() const {
    return graphics_.context.has_window() ? graphics_.display->size_px() : std::nullopt;
}

bool Screen::show(const gles::Texture& picture) {
    const std::optional<SizePx> size = size_px();
    if (graphics_lost_ || !size) return false;
    gles::show_in_window(graphics_.gpu, picture, {size->width, size->height});
    if (!graphics_.context.swap()) {
        // What the GPU drew is lost with it; a window that is none any more is given back for another.
        if (graphics_.context.reset_status() != gles::ResetStatus::None)
            graphics_lost_ = true;
        else
            graphics_.display->refuse_window();
        return false;
    }
    graphics_.display->present();
    ++shown_;
    return true;
}

void Screen::remember() {
    if (memory_.empty() || state_ != DisplayState::Showing || graphics_.display->counters().flips == 0)
        return;
    const std::string id = graphics_.display->screen_id();
    if (id.empty() || id == remembered_) return;
    remembered_ = id;
    try {
        replace_text_file(memory_, id + "\n");
    } catch (const std::runtime_error& e) {
        fmt::print(stderr, "screen: it cannot be remembered which one this is: {}\n", e.what());
    }
}

std::optional<Screen::News> Screen::news() {
    const std::string problem = graphics_.display->problem();
    if (problem.empty() && state_ != DisplayState::Showing) return std::nullopt;  // as was wished
    std::string text =
        fmt::format("{}: {}", to_string(state_), problem.empty() ? graphics_.display->describe() : problem);
    if (text == said_) return std::nullopt;
    said_ = text;
    return News{state_, std::move(text)};
}

}  // namespace eddy
