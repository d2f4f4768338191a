#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hal/clock.h"

namespace eddy {

struct SizePx {
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
    bool operator==(const SizePx&) const = default;
};

enum class DisplayState {
    Showing,    ///< what is drawn is seen
    NoMonitor,  ///< nothing to show it on, now; problem() says why, and it comes back by itself
    Asleep,     ///< told to be dark
    Moved,      ///< the screen is on another card: only a new process can draw there
    Lost,       ///< given up, whatever was tried: a new process may help, or a new start of the machine
};
const char* to_string(DisplayState state);

/// What happened to a display since it was opened.
struct DisplayCounters {
    long flips = 0;         ///< frames that came onto the screen
    long late = 0;          ///< of these, more than one and a half refresh periods after they were sent
    long replaced = 0;      ///< frames that a newer one overtook before they were sent
    long modesets = 0;      ///< modes that were set
    long refused = 0;       ///< what the kernel would not do when asked
    long hot_plugs = 0;     ///< changes of the plugs that were looked into
    long recoveries = 0;    ///< modes set again because no frame came onto the screen
    long reopenings = 0;    ///< cards opened again, because that did not help either
    long wake_retries = 0;  ///< tries to wake the screen after the first
    long master_lost = 0;   ///< times that another program took the screen
    bool operator==(const DisplayCounters&) const = default;
};

/// Where pictures go. Hands out what EGL needs (the arguments of eglGetPlatformDisplay and
/// eglCreatePlatformWindowSurface), so that whoever draws needs to know nothing of screens. GL thread only.
/// While the show runs nothing here throws, and nothing waits for longer than a frame but the kernel while it sets a mode or
/// looks for monitors.
class Display {
  public:
    virtual ~Display() = default;
    virtual unsigned egl_platform() const = 0;
    virtual void* native_display() const = 0;
    virtual void* native_window() const = 0;  ///< null: there is no screen, draw into textures
    /// Of the window; none if there is no screen. A size without a native window is that of a window nobody sees.
    virtual std::optional<SizePx> size_px() const = 0;
    /// Another number, another window: its drawer must make its surface anew (or do without, if there is none now) before it
    /// draws. The old window stays valid until the first present() after that.
    virtual long window_number() const = 0;
    /// The drawer could make no surface of this window: another kind is tried, if there is one.
    virtual void refuse_window() = 0;

    /// To be called at least once a frame: takes in what happened, does what is due. `now` never goes back.
    virtual DisplayState poll(Instant now) = 0;
    /// Whether a frame that is presented now would be seen in its time: if not, drawing one would be in vain.
    virtual bool wants_frame() const = 0;
    /// Puts the buffer that eglSwapBuffers just finished on the screen: at once, or, while the last one is still on its way,
    /// as soon as that arrived, unless a newer one overtakes it. Once per frame, after the swap.
    virtual void present() = 0;
    /// Opening hours: dark, or not. Waking shows in the state once a frame came onto the screen; tried again until one does.
    virtual void set_awake(bool awake) = 0;

    virtual DisplayCounters counters() const = 0;
    /// Why the state is not what was wished, and what to do about it; empty if it is.
    virtual std::string problem() const = 0;
    /// Which screen it is, the same after a restart and on another plug; empty if none is known.
    virtual std::string screen_id() const = 0;
    virtual std::string describe() const = 0;  ///< for the log
};

/// No screen: the GPU of an EGL device if the machine has one, else the software rasteriser.
std::unique_ptr<Display> make_headless_display();
/// No screen and no GPU: Mesa's surfaceless platform, which every machine with Mesa has.
std::unique_ptr<Display> make_software_display();

}  // namespace eddy
