#include "gles/program.h"

#include <GLES3/gl3.h>
#include <fmt/format.h>

#include <algorithm>

#include "gles/context.h"
#include "gles/shader_source.h"

namespace eddy::gles {
namespace {

/// Programs that no pass uses any more are kept up to this number: those of about six scenes.
constexpr std::ptrdiff_t kIdlePrograms = 400;

unsigned compile(GLenum kind, std::string_view path, const std::string& switches,
                 const std::string& declarations) {
    const ShaderSource source = load_shader(path, switches, declarations);
    const GLuint shader = glCreateShader(kind);
    const GLchar* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    std::string log(8192, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    glDeleteShader(shader);
    throw GlError(fmt::format("{} does not compile:\n{}", path, source.locate(log)));
}

}  // namespace

Program::Program(const Source& source) {
    const unsigned vertex =
        compile(GL_VERTEX_SHADER, "gles/pass.vert", "#define VERTEX_SHADER\n", source.target);
    const unsigned fragment =
        compile(GL_FRAGMENT_SHADER, source.shader, source.switches, source.declarations);
    id_ = glCreateProgram();
    glAttachShader(id_, vertex);
    glAttachShader(id_, fragment);
    glLinkProgram(id_);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    GLint ok = GL_FALSE;
    glGetProgramiv(id_, GL_LINK_STATUS, &ok);
    if (!ok) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        glDeleteProgram(id_);
        throw GlError(fmt::format("{} does not link:\n{}", source.shader, log));
    }

    GLint count = 0;
    glGetProgramiv(id_, GL_ACTIVE_UNIFORMS, &count);
    glUseProgram(id_);
    int unit = 0;
    for (GLint i = 0; i < count; ++i) {
        GLchar text[64];
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(id_, static_cast<GLuint>(i), sizeof text, nullptr, &size, &type, text);
        std::string uniform(text);
        const int location = glGetUniformLocation(id_, text);
        if (uniform == "rect")
            rect_ = location;
        else if (uniform == "first_slab")
            first_slab_ = location;
        else {
            if (const std::size_t bracket = uniform.find('['); bracket != std::string::npos)
                uniform.resize(bracket);
            const bool is_sampler = type == GL_SAMPLER_2D;
            // A sampler's "location" here is its texture unit: set once, never changed.
            if (is_sampler) glUniform1i(location, unit);
            uniforms_.push_back({uniform, is_sampler ? unit++ : location, is_sampler});
        }
    }
}

Program::~Program() {
    glDeleteProgram(id_);
}

std::shared_ptr<const Program> ProgramCache::get(const Program::Source& source) {
    const auto known = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& entry) { return entry.source == source; });
    if (known != entries_.end()) {
        entries_.splice(entries_.begin(), entries_, known);
        return entries_.front().program;
    }
    entries_.push_front({source, std::make_shared<const Program>(source)});
    ++linked_;
    const std::shared_ptr<const Program> made = entries_.front().program;
    const auto idle = [](const Entry& entry) { return entry.program.use_count() == 1; };
    if (std::count_if(entries_.begin(), entries_.end(), idle) > kIdlePrograms)
        entries_.erase(std::prev(std::find_if(entries_.rbegin(), entries_.rend(), idle).base()));
    return made;
}

}  // namespace eddy::gles
