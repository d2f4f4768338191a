#include "gles/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <fmt/format.h>

#include <set>

namespace eddy::gles {
namespace {

std::string egl_failure(const char* call) {
    return fmt::format("{} failed with EGL error {:#06x}", call, eglGetError());
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    std::string result;
    for (; text && *text; ++text) result += static_cast<char>(*text);
    return result;
}

Capabilities ask_driver() {
    std::set<std::string> extensions;
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* name = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        std::string text;
        for (; name && *name; ++name) text += static_cast<char>(*name);
        extensions.insert(text);
    }
    Capabilities c;
    c.renderer = gl_string(GL_RENDERER);
    c.vendor = gl_string(GL_VENDOR);
    c.version = gl_string(GL_VERSION);
    c.filters_float = extensions.contains("GL_OES_texture_float_linear");
    c.timer_query = extensions.contains("GL_EXT_disjoint_timer_query");
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &c.max_texture_size);
    glGetIntegerv(GL_MAX_DRAW_BUFFERS, &c.max_draw_buffers);
    if (!extensions.contains("GL_EXT_color_buffer_float"))
        throw GlError(fmt::format(
            "{} cannot draw into 32-bit float textures (EXT_color_buffer_float is missing); the fluid needs "
            "them. Try a newer driver, or the software rasteriser: LIBGL_ALWAYS_SOFTWARE=1",
            c.renderer));
    return c;
}

}  // namespace

struct Context::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;

    ~Egl() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }
};

Context::Context(const NativeDisplay& native) : egl_(std::make_unique<Egl>()) {
    Egl& egl = *egl_;
    egl.display = eglGetPlatformDisplay(native.platform, native.native_display, nullptr);
    if (egl.display == EGL_NO_DISPLAY)
        throw GlError(egl_failure("eglGetPlatformDisplay") +
                      "; is a GL driver installed (libegl1, libgl1-mesa-dri)?");
    if (!eglInitialize(egl.display, nullptr, nullptr))
        throw GlError(egl_failure("eglInitialize") +
                      "; is a GL driver installed (libegl1, libgl1-mesa-dri)?");
    eglBindAPI(EGL_OPENGL_ES_API);

    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             native.native_window ? EGL_WINDOW_BIT : 0,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_ES3_BIT,
                             EGL_RED_SIZE,
                             8,
                             EGL_GREEN_SIZE,
                             8,
                             EGL_BLUE_SIZE,
                             8,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!eglChooseConfig(egl.display, wanted, &config, 1, &found) || found == 0) {
        if (native.native_window)
            throw GlError("no EGL configuration with ES 3 and 8-bit colour for this window");
        config = nullptr;  // EGL_KHR_no_config_context: a context without a surface needs none
    }
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    egl.context = eglCreateContext(egl.display, config, EGL_NO_CONTEXT, attributes);
    if (egl.context == EGL_NO_CONTEXT) throw GlError(egl_failure("eglCreateContext (OpenGL ES 3.0)"));
    if (native.native_window) {
        egl.surface = eglCreatePlatformWindowSurface(egl.display, config, native.native_window, nullptr);
        if (egl.surface == EGL_NO_SURFACE) throw GlError(egl_failure("eglCreatePlatformWindowSurface"));
    }
    if (!eglMakeCurrent(egl.display, egl.surface, egl.surface, egl.context))
        throw GlError(egl_failure("eglMakeCurrent"));
    capabilities_ = ask_driver();
}

Context::~Context() = default;

void Context::swap() {
    if (egl_->surface != EGL_NO_SURFACE) eglSwapBuffers(egl_->display, egl_->surface);
}

bool Context::has_window() const {
    return egl_->surface != EGL_NO_SURFACE;
}

}  // namespace eddy::gles
