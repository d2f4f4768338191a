#pragma once
#include <memory>
#include <stdexcept>
#include <string>

namespace eddy::gles {

/// Start-up trouble with EGL, GL or a shader: what, where, and what to try. The program cannot go on.
struct GlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What a display hands over: the arguments of eglGetPlatformDisplay and eglCreatePlatformWindowSurface.
struct NativeDisplay {
    unsigned platform = 0;           ///< EGL_PLATFORM_..., for instance EGL_PLATFORM_GBM_KHR
    void* native_display = nullptr;  ///< of that platform; may be null (EGL_DEFAULT_DISPLAY)
};

/// What a display's window is to EGL.
struct NativeWindow {
    void* handle = nullptr;  ///< null: one that nobody sees, of the size below (a pbuffer)
    int width_px = 0, height_px = 0;
};

/// What this driver can do, asked once. Passes ask these flags; nobody asks the vendor string.
struct Capabilities {
    std::string renderer;        ///< GL_RENDERER
    std::string vendor;          ///< GL_VENDOR
    std::string version;         ///< GL_VERSION
    bool filters_float = false;  ///< OES_texture_float_linear: 32-bit textures can be sampled linearly
    bool timer_query = false;    ///< EXT_disjoint_timer_query
    bool tells_of_resets =
        false;                 ///< a context with reset notification, and KHR_ or EXT_robustness to ask it
    int max_texture_size = 0;  ///< texels
    int max_draw_buffers = 0;  ///< colour attachments written by one pass
};

/// What happened to the GPU. Anything but None: all textures and programs are gone, and nothing that is drawn is real.
enum class ResetStatus {
    None,
    Guilty,    ///< by what this program did
    Innocent,  ///< by what another did
    Unknown,
};
/// Of what glGetGraphicsResetStatus returned; numbers that it must not return are noise.
ResetStatus reset_status_from(unsigned value);

/// An OpenGL ES 3 context, current on the thread that made it until it is destroyed there.
class Context {
  public:
    /// Without a window: everything is drawn into textures until set_window(). Throws GlError if EGL, ES 3.0 or float render targets
    /// (EXT_color_buffer_float) are missing.
    explicit Context(const NativeDisplay& display);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Capabilities& capabilities() const { return capabilities_; }
    /// From now on the default framebuffer is this window; textures and programs stay. The window before is let go of. Throws
    /// GlError, and has none then.
    void set_window(const NativeWindow& window);
    /// None: everything is drawn into textures.
    void take_window_away();
    /// Shows what was drawn to the window; does nothing without one. False: the driver says that it could not.
    bool swap();
    bool has_window() const;
    /// What happened since the context was made; to be asked once a frame. Always None where the driver does not tell
    /// (Capabilities::tells_of_resets).
    ResetStatus reset_status() const;

  private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
    Capabilities capabilities_;
};

}  // namespace eddy::gles
