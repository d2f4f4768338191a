#pragma once
#include <filesystem>
#include <memory>

#include "config/exhibit.h"
#include "gles/context.h"
#include "gles/gpu.h"
#include "hal/display/display.h"

namespace eddy {

/// A display, a GL context on it and the GPU's state, brought up in this order and taken down in reverse.
/// Throws gles::GlError with what to try.
struct Graphics {
    explicit Graphics(std::unique_ptr<Display> display_)
        : display(std::move(display_)),
          context({display->egl_platform(), display->native_display()}),
          gpu(context.capabilities()) {}

    /// The processor does the drawing.
    bool in_software() const;

    std::unique_ptr<Display> display;
    gles::Context context;
    gles::Gpu gpu;
    bool lacks_card = false;  ///< a screen was wished for, and there was no card that could drive one
};

/// Graphics without a screen: on the GPU if there is one that can be opened, else in software, which it says on
/// standard error. Throws gles::GlError if neither works.
std::unique_ptr<Graphics> open_headless();

/// Graphics on the machine's screen, as the exhibit's settings wish it; a monitor may come later. `state_dir` knows the screen of
/// last time. Throws std::runtime_error if there is no card, or GL cannot be used on it.
std::unique_ptr<Graphics> open_screen(const ScreenConfig& config, const std::filesystem::path& state_dir);

/// Where the exhibit's picture goes: the screen; no screen; or the first that can be had, which is said on standard error if it is
/// not the screen. Throws as the two above.
std::unique_ptr<Graphics> open_display(DisplayChoice choice, const ScreenConfig& config,
                                       const std::filesystem::path& state_dir);

/// Whether a card that could drive a screen has come up since: only a new process can use it, for what GL has drawn lies elsewhere.
bool card_has_come();

/// After a reset of the GPU: a new context on the same display, as soon as the driver has got over it. All that was made with the
/// old one must be gone. Throws gles::GlError if that takes longer than `patience`, or does not work.
std::unique_ptr<Graphics> open_again(std::unique_ptr<Graphics> lost, Seconds patience = Seconds(2.0));

/// The file in the state folder that says which screen was used last.
std::filesystem::path screen_memory(const std::filesystem::path& state_dir);
/// What it says; empty: nothing.
std::string last_screen(const std::filesystem::path& state_dir);

}  // namespace eddy
