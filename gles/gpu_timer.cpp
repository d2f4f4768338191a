#include "gles/gpu_timer.h"

#include <EGL/egl.h>
#include <GLES3/gl3.h>
// After gl3.h, whose types it uses.
#include <GLES2/gl2ext.h>

#include "gles/context.h"

namespace eddy::gles {
namespace {

/// Of the extension alone: ES 3 has only the 32-bit one, which overflows after 4 s.
PFNGLGETQUERYOBJECTUI64VEXTPROC get_nanoseconds() {
    static const auto function =
        reinterpret_cast<PFNGLGETQUERYOBJECTUI64VEXTPROC>(eglGetProcAddress("glGetQueryObjectui64vEXT"));
    if (!function) throw GlError("EXT_disjoint_timer_query lacks glGetQueryObjectui64vEXT in this driver");
    return function;
}

bool was_disturbed() {
    GLint disjoint = GL_FALSE;
    glGetIntegerv(GL_GPU_DISJOINT_EXT, &disjoint);  // and starts anew
    return disjoint != GL_FALSE;
}

}  // namespace

GpuTimer::GpuTimer() {
    glGenQueries(1, &query_);
}

GpuTimer::~GpuTimer() {
    glDeleteQueries(1, &query_);
}

void GpuTimer::begin() {
    was_disturbed();
    glBeginQuery(GL_TIME_ELAPSED_EXT, query_);
}

void GpuTimer::end() {
    glEndQuery(GL_TIME_ELAPSED_EXT);
}

std::optional<double> GpuTimer::milliseconds() {
    GLuint64 nanoseconds = 0;
    get_nanoseconds()(query_, GL_QUERY_RESULT, &nanoseconds);
    if (was_disturbed()) return std::nullopt;
    return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace eddy::gles
