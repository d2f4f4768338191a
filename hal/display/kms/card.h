#pragma once
#include <xf86drmMode.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/clock.h"

// The seam between the display and the kernel: the calls of kernel mode setting that the display uses, as few and as thin as can
// be. drm_card.cpp makes them through libdrm; hal/display/emulated plays the kernel. What can fail returns 0 or an errno
// (positive), for each has its own answer: EACCES another program has the screen, EBUSY not yet, ENODEV the card is gone.

namespace eddy::kms {

enum class Connection { Connected, Disconnected, Unknown };

struct Property {
    std::uint32_t id = 0;
    std::string name;
    std::uint64_t value = 0;
};

struct Connector {
    std::uint32_t id = 0;
    std::string name;  ///< as in /sys/class/drm, without the card: "HDMI-A-1"
    Connection connection = Connection::Unknown;
    std::vector<drmModeModeInfo> modes;
    std::vector<std::uint32_t> crtcs;  ///< that can drive it
    std::uint32_t crtc_now = 0;        ///< that does; 0: none
    std::vector<Property> properties;
};

struct Crtc {
    std::uint32_t id = 0;
    std::uint32_t framebuffer = 0;  ///< 0: none
    std::uint32_t x = 0, y = 0;
    std::optional<drmModeModeInfo> mode;  ///< none: off
};

struct Plane {
    std::uint32_t id = 0;
    std::vector<std::uint32_t> crtcs;    ///< that it can lie on
    std::vector<std::uint32_t> formats;  ///< DRM_FORMAT_...
    std::vector<Property> properties;
};

struct FormatModifier {
    std::uint32_t format = 0;
    std::uint64_t modifier = 0;
};

/// A finished picture in memory of the graphics card.
struct Buffer {
    std::uint32_t width = 0, height = 0, format = 0;
    std::uint64_t modifier = 0;  ///< DRM_FORMAT_MOD_INVALID: the driver's own choice, not to be named
    int planes = 1;
    std::uint32_t handles[4]{}, pitches[4]{}, offsets[4]{};
    int owner_fd = -1;  ///< of the card that the handles belong to
};

/// One line of an atomic commit.
struct Setting {
    std::uint32_t object = 0, property = 0;
    std::uint64_t value = 0;
};

/// A page flip that happened.
struct FlipEvent {
    std::uint32_t crtc = 0;
    Instant time{0};  ///< on Card::clock()
    std::uint32_t sequence = 0;
};

/// An open card. One thread.
class Card {
  public:
    virtual ~Card() = default;
    virtual std::string path() const = 0;
    virtual int fd() const = 0;

    /// Whether this program may change what is on the screen.
    virtual bool is_master() const = 0;
    virtual int take_master() = 0;
    virtual void drop_master() = 0;
    /// Asks for atomic commits and for all planes; false: this driver has only the older calls.
    virtual bool enable_atomic() = 0;
    /// Whether framebuffers may name modifiers.
    virtual bool has_modifiers() const = 0;

    /// With `probe` the kernel asks each plug, which may take a tenth of a second; without, it says what it knows.
    virtual std::vector<Connector> connectors(bool probe) = 0;
    virtual std::vector<Crtc> crtcs() = 0;
    virtual std::vector<Property> crtc_properties(std::uint32_t crtc) = 0;
    virtual std::vector<Plane> planes() = 0;
    virtual std::vector<std::uint8_t> blob(std::uint32_t id) = 0;
    /// What a plane's IN_FORMATS says.
    virtual std::vector<FormatModifier> formats_in(std::uint32_t blob) = 0;

    virtual int add_framebuffer(const Buffer& buffer, std::uint32_t& id) = 0;
    virtual void remove_framebuffer(std::uint32_t id) = 0;
    virtual int create_mode_blob(const drmModeModeInfo& mode, std::uint32_t& id) = 0;
    virtual void destroy_blob(std::uint32_t id) = 0;

    /// `flags` are DRM_MODE_ATOMIC_... and DRM_MODE_PAGE_FLIP_EVENT.
    virtual int commit(std::span<const Setting> settings, std::uint32_t flags) = 0;
    /// The older calls. No mode: off.
    virtual int set_crtc(std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t x, std::uint32_t y,
                         std::span<const std::uint32_t> connectors, const drmModeModeInfo* mode) = 0;
    virtual int page_flip(std::uint32_t crtc, std::uint32_t framebuffer) = 0;
    virtual int set_connector_property(std::uint32_t connector, std::uint32_t property,
                                       std::uint64_t value) = 0;

    /// Flips since the last call; does not wait.
    virtual std::vector<FlipEvent> events() = 0;
    /// Until there is one.
    virtual void wait(std::chrono::milliseconds at_most) = 0;
    /// The clock that events are stamped with.
    virtual Instant clock() const = 0;
};

/// The memory layout that a window's buffers have.
enum class Layout {
    Modifiers,  ///< any that card and GPU can both use
    Own,        ///< the driver chooses
    Linear,     ///< row after row
};

/// A ring of buffers that GL draws into.
class Window {
  public:
    virtual ~Window() = default;
    virtual void* native() const = 0;  ///< for eglCreatePlatformWindowSurface
    /// The buffer that eglSwapBuffers just finished, which stays as it is until it is released; null if there is none. The same
    /// pointer is the same buffer, as long as the window lives.
    virtual const Buffer* lock_front() = 0;
    virtual void release(const Buffer* buffer) = 0;
    /// Whether GL has one left to draw into.
    virtual bool has_free() const = 0;
};

/// Makes windows in the memory of one card.
class WindowMaker {
  public:
    virtual ~WindowMaker() = default;
    virtual void* native() const = 0;  ///< for eglGetPlatformDisplay
    virtual unsigned egl_platform() const = 0;
    /// Null if the driver cannot.
    virtual std::unique_ptr<Window> make(std::uint32_t width, std::uint32_t height, std::uint32_t format,
                                         Layout layout, std::span<const std::uint64_t> modifiers) = 0;
};

/// The machine as the display sees it: its cards, its plugs, and the console that would write over the picture.
class Machine {
  public:
    virtual ~Machine() = default;
    /// Of all cards that can drive a screen, as "/dev/dri/card0".
    virtual std::vector<std::string> cards() = 0;
    struct Opened {
        std::unique_ptr<Card> card;  ///< null: `error` says why
        int error = 0;
    };
    virtual Opened open(const std::string& path) = 0;
    virtual std::unique_ptr<WindowMaker> make_windows(Card& card) = 0;
    /// Whether a plug changed since the last call, as far as the kernel told.
    virtual bool plugs_changed() = 0;
    /// Who has the card open besides this process, as "plymouthd (process 231)"; empty if that cannot be seen.
    virtual std::string holders(const std::string& path) = 0;
    /// Keeps the console's text off the screen, where this process owns one; the other way round, gives it back.
    virtual void set_console_text(bool on) = 0;
};

/// This one.
std::unique_ptr<Machine> make_machine();

}  // namespace eddy::kms
