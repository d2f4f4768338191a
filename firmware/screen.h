#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "firmware/graphics.h"
#include "gles/texture.h"

namespace eddy {

/// Exit status with which a service manager is asked to start the program again (EX_TEMPFAIL).
inline constexpr int kExitForRestart = 75;

/// How large a picture is drawn for a window: of its shape, of no more than so many pixels (0: of as many as it has), each side even.
SizePx picture_size(const SizePx& window, long max_pixels);

/// Pictures on the display: follows its windows as they come and go, and says what became of a picture. Nothing here throws. GL
/// thread only; before the Graphics go, it goes.
class Screen {
  public:
    /// `memory`: the file that keeps which screen was used last (screen_memory()); empty: none.
    explicit Screen(Graphics& graphics, std::filesystem::path memory = {});

    /// Once each turn of the show's loop, picture or not. Moved or Lost: end the program with kExitForRestart.
    DisplayState poll(Instant now);
    /// The GPU was reset: all textures are gone. Everything made with these Graphics must be made anew on open_again(), or the program
    /// ends with kExitForRestart.
    bool graphics_lost() const { return graphics_lost_; }
    /// Whether a picture shown now would be seen in its time. If not, to draw one is in vain.
    bool wants_picture() const;
    /// Of the window; none: there is none now.
    std::optional<SizePx> size_px() const;
    /// Shows a picture (RGBA8, first row at the bottom) as large as fits. False: it could not be shown, now.
    bool show(const gles::Texture& picture);
    /// Opening hours.
    void set_awake(bool awake) { graphics_.display->set_awake(awake); }
    struct News {
        DisplayState state;
        std::string text;  ///< a line for the log
    };
    /// When there is something new to say of the screen.
    std::optional<News> news();
    long shown() const { return shown_; }  ///< pictures

  private:
    void follow_window();
    void remember();

    Graphics& graphics_;
    std::filesystem::path memory_;
    std::string remembered_;
    long window_ = -1;  ///< number of the window that GL draws into
    DisplayState state_ = DisplayState::NoMonitor;
    bool graphics_lost_ = false;
    long shown_ = 0;
    std::string said_;
};

}  // namespace eddy
