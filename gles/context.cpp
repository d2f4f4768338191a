#include "gles/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <fmt/format.h>

#include <set>
#include <string_view>
#include <vector>

namespace eddy::gles {
namespace {

bool has_extension(const char* list, std::string_view name) {
    if (!list) return false;
    const std::string_view all(list);
    for (std::size_t at = all.find(name); at != all.npos; at = all.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
    }
    return false;
}

std::string egl_failure(const char* call) {
    return fmt::format("{} failed with EGL error {:#06x}", call, eglGetError());
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    std::string result;
    for (; text && *text; ++text) result += static_cast<char>(*text);
    return result;
}

/// `reset_status`: the function that tells of resets; null: there is none.
Capabilities ask_driver(const char*& reset_status) {
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
    reset_status = extensions.contains("GL_KHR_robustness")   ? "glGetGraphicsResetStatusKHR"
                   : extensions.contains("GL_EXT_robustness") ? "glGetGraphicsResetStatusEXT"
                                                              : nullptr;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &c.max_texture_size);
    glGetIntegerv(GL_MAX_DRAW_BUFFERS, &c.max_draw_buffers);
    if (!extensions.contains("GL_EXT_color_buffer_float"))
        throw GlError(fmt::format(
            "{} cannot draw into 32-bit float textures (EXT_color_buffer_float is missing); the fluid needs "
            "them. Try a newer driver, or the software rasteriser: LIBGL_ALWAYS_SOFTWARE=1",
            c.renderer));
    return c;
}

/// ES 3 with 8-bit colour, for surfaces of that kind.
std::vector<EGLConfig> find_configs(EGLDisplay display, EGLint surface_type) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             surface_type,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_ES3_BIT,
                             EGL_RED_SIZE,
                             8,
                             EGL_GREEN_SIZE,
                             8,
                             EGL_BLUE_SIZE,
                             8,
                             EGL_NONE};
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, nullptr, 0, &count)) return {};
    std::vector<EGLConfig> configs(static_cast<std::size_t>(count));
    if (!eglChooseConfig(display, wanted, configs.data(), count, &count)) return {};
    configs.resize(static_cast<std::size_t>(count));
    return configs;
}

/// Those whose pixels a screen shows: on GBM the native visual is their DRM format.
std::vector<EGLConfig> window_configs(EGLDisplay display) {
    constexpr EGLint kXrgb8888 = 0x34325258, kArgb8888 = 0x34325241;  // "XR24", "AR24"
    const std::vector<EGLConfig> all = find_configs(display, EGL_WINDOW_BIT);
    std::vector<EGLConfig> result;
    for (const EGLint wanted : {kXrgb8888, kArgb8888})
        for (const EGLConfig config : all) {
            EGLint visual = 0;
            if (eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &visual) && visual == wanted)
                result.push_back(config);
        }
    return result;
}

/// One that tells when the GPU was reset, as EGL 1.5 asks for it, else as its extension did, else one that does not.
EGLContext make_context(EGLDisplay display, EGLConfig config, bool& tells_of_resets) {
    constexpr EGLint kVersion[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0};
    constexpr EGLint kBy15[] = {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                                EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET};
    constexpr EGLint kByExtension[] = {EGL_CONTEXT_OPENGL_ROBUST_ACCESS_EXT, EGL_TRUE,
                                       EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                                       EGL_LOSE_CONTEXT_ON_RESET_EXT};
    for (const EGLint* robust : {kBy15, kByExtension, static_cast<const EGLint*>(nullptr)}) {
        std::vector<EGLint> attributes(std::begin(kVersion), std::end(kVersion));
        if (robust) attributes.insert(attributes.end(), robust, robust + std::size(kBy15));
        attributes.push_back(EGL_NONE);
        tells_of_resets = robust != nullptr;
        const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
        if (context != EGL_NO_CONTEXT) return context;
    }
    return EGL_NO_CONTEXT;
}

using GetResetStatus = GLenum(GL_APIENTRY*)();

}  // namespace

ResetStatus reset_status_from(unsigned value) {
    switch (value) {  // KHR_robustness and EXT_robustness agree on the numbers
        case 0x8253:
            return ResetStatus::Guilty;
        case 0x8254:
            return ResetStatus::Innocent;
        case 0x8255:
            return ResetStatus::Unknown;
        default:
            return ResetStatus::None;
    }
}

struct Context::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    EGLSurface surface = EGL_NO_SURFACE;
    EGLConfig config = nullptr;  ///< of the context; null: surfaces of any
    GetResetStatus get_reset_status = nullptr;

    bool use(EGLSurface wanted) {
        if (!eglMakeCurrent(display, wanted, wanted, context)) return false;
        if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
        surface = wanted;
        return true;
    }

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

    // With EGL_KHR_no_config_context windows of every configuration will do; without, those of the context's own.
    const char* const extensions = eglQueryString(egl.display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_no_config_context")) {
        std::vector<EGLConfig> configs = window_configs(egl.display);
        if (configs.empty()) configs = find_configs(egl.display, 0);
        if (configs.empty()) throw GlError("no EGL configuration with ES 3 and 8-bit colour");
        egl.config = configs.front();
    }
    bool tells_of_resets = false;
    egl.context = make_context(egl.display, egl.config, tells_of_resets);
    if (egl.context == EGL_NO_CONTEXT) throw GlError(egl_failure("eglCreateContext (OpenGL ES 3.0)"));
    if (!egl.use(EGL_NO_SURFACE)) throw GlError(egl_failure("eglMakeCurrent"));
    const char* reset_status = nullptr;
    capabilities_ = ask_driver(reset_status);
    // eglGetProcAddress returns a function of unknown type; the cast is what EGL asks for.
    if (tells_of_resets && reset_status)
        egl.get_reset_status = reinterpret_cast<GetResetStatus>(eglGetProcAddress(reset_status));
    capabilities_.tells_of_resets = egl.get_reset_status != nullptr;
}

Context::~Context() = default;

void Context::set_window(const NativeWindow& window) {
    Egl& egl = *egl_;
    take_window_away();  // a window that is still in use cannot be given to another surface
    std::vector<EGLConfig> configs =
        window.handle ? window_configs(egl.display) : find_configs(egl.display, EGL_PBUFFER_BIT);
    if (!window.handle && !configs.empty()) configs.resize(1);
    if (egl.config) configs = {egl.config};
    std::string trouble = "no EGL configuration with ES 3 and 8-bit colour for it";
    for (const EGLConfig config : configs) {
        const EGLint size[] = {EGL_WIDTH, window.width_px, EGL_HEIGHT, window.height_px, EGL_NONE};
        const EGLSurface surface =
            window.handle ? eglCreatePlatformWindowSurface(egl.display, config, window.handle, nullptr)
                          : eglCreatePbufferSurface(egl.display, config, size);
        if (surface == EGL_NO_SURFACE) {
            trouble =
                egl_failure(window.handle ? "eglCreatePlatformWindowSurface" : "eglCreatePbufferSurface");
            continue;
        }
        if (egl.use(surface)) {
            // A context that began without a window draws into none until it is told to.
            constexpr GLenum kBack = GL_BACK;
            glBindFramebuffer(GL_FRAMEBUFFER, 0);
            glDrawBuffers(1, &kBack);
            glReadBuffer(GL_BACK);
            return;
        }
        trouble = egl_failure("eglMakeCurrent");
        eglDestroySurface(egl.display, surface);
        egl.use(EGL_NO_SURFACE);
    }
    throw GlError(fmt::format("the driver cannot draw into this window of {}x{} pixels: {}", window.width_px,
                              window.height_px, trouble));
}

void Context::take_window_away() {
    if (has_window()) egl_->use(EGL_NO_SURFACE);
}

bool Context::swap() {
    return !has_window() || eglSwapBuffers(egl_->display, egl_->surface) == EGL_TRUE;
}

bool Context::has_window() const {
    return egl_->surface != EGL_NO_SURFACE;
}

ResetStatus Context::reset_status() const {
    return egl_->get_reset_status ? reset_status_from(egl_->get_reset_status()) : ResetStatus::None;
}

}  // namespace eddy::gles
