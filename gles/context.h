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
    void* native_window = nullptr;   ///< null: no surface, everything is drawn into textures
};

/// What this driver can do, asked once. Passes ask these flags; nobody asks the vendor string.
struct Capabilities {
    std::string renderer;        ///< GL_RENDERER
    std::string vendor;          ///< GL_VENDOR
    std::string version;         ///< GL_VERSION
    bool filters_float = false;  ///< OES_texture_float_linear: 32-bit textures can be sampled linearly
    bool timer_query = false;    ///< EXT_disjoint_timer_query
    int max_texture_size = 0;    ///< texels
    int max_draw_buffers = 0;    ///< colour attachments written by one pass
};

/// An OpenGL ES 3 context, current on the thread that made it until it is destroyed there.
class Context {
  public:
    /// Throws GlError if EGL, ES 3.0 or float render targets (EXT_color_buffer_float) are missing.
    explicit Context(const NativeDisplay& display);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Capabilities& capabilities() const { return capabilities_; }
    /// Shows what was drawn to the window surface; does nothing without one.
    void swap();
    bool has_window() const;

  private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
    Capabilities capabilities_;
};

}  // namespace eddy::gles
