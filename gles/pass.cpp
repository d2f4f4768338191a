#include "gles/pass.h"

#include <GLES3/gl3.h>
#include <fmt/format.h>

#include "gles/shader_source.h"

namespace eddy::gles {
namespace {

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

struct SetUniform {
    int at;
    void operator()(int v) const { glUniform1i(at, v); }
    void operator()(float v) const { glUniform1f(at, v); }
    void operator()(const glm::vec2& v) const { glUniform2f(at, v.x, v.y); }
    void operator()(const glm::vec3& v) const { glUniform3f(at, v.x, v.y, v.z); }
    void operator()(const glm::vec4& v) const { glUniform4f(at, v.x, v.y, v.z, v.w); }
    void operator()(const glm::ivec3& v) const { glUniform3i(at, v.x, v.y, v.z); }
    void operator()(const glm::mat3& v) const { glUniformMatrix3fv(at, 1, GL_FALSE, &v[0].x); }
    void operator()(const glm::mat4& v) const { glUniformMatrix4fv(at, 1, GL_FALSE, &v[0].x); }
    void operator()(const std::vector<glm::vec3>& v) const {
        glUniform3fv(at, static_cast<GLsizei>(v.size()), &v.data()->x);
    }
    void operator()(const std::vector<glm::vec4>& v) const {
        glUniform4fv(at, static_cast<GLsizei>(v.size()), &v.data()->x);
    }
};

std::string switches(const Gpu& gpu, const Variant& variant) {
    std::string text = gpu.filters_float() ? "#define FILTERS_FLOAT\n" : "";
    for (const auto& [name, value] : variant.defines) text += fmt::format("#define {} {}\n", name, value);
    return text;
}

std::vector<std::string> switch_names(const Variant& variant) {
    std::vector<std::string> names;
    for (const auto& [name, value] : variant.defines) names.push_back(name);
    return names;
}

std::string declarations(const AtlasLayout& target, const Variant& variant) {
    std::string text = target.declaration("TARGET");
    for (const auto& [name, layout] : variant.layouts) text += layout.declaration(name);
    return text + variant.declarations;
}

}  // namespace

std::string glsl(const glm::ivec3& v) {
    return fmt::format("ivec3({}, {}, {})", v.x, v.y, v.z);
}

Region Region::packed(std::vector<Box> boxes) {
    for (Box& box : boxes) {
        box.lo.z = box.lo.z / 4;
        box.hi.z = (box.hi.z + 3) / 4;
    }
    return Region(std::move(boxes));
}

Pass::Pass(Gpu& gpu, std::string name, std::string_view shader, const AtlasLayout& target,
           const Variant& variant)
    : gpu_(&gpu),
      name_(std::move(name)),
      shader_(shader),
      target_(target),
      fetches_(declared_fetches(shader, switch_names(variant))) {
    const std::string defines = switches(gpu, variant), constants = declarations(target, variant);
    const unsigned vertex =
        compile(GL_VERTEX_SHADER, "gles/pass.vert", "#define VERTEX_SHADER\n", target.declaration("TARGET"));
    const unsigned fragment = compile(GL_FRAGMENT_SHADER, shader, defines, constants);
    program_ = glCreateProgram();
    glAttachShader(program_, vertex);
    glAttachShader(program_, fragment);
    glLinkProgram(program_);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    GLint ok = GL_FALSE;
    glGetProgramiv(program_, GL_LINK_STATUS, &ok);
    if (!ok) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        throw GlError(fmt::format("{} does not link:\n{}", shader, log));
    }

    GLint count = 0;
    glGetProgramiv(program_, GL_ACTIVE_UNIFORMS, &count);
    glUseProgram(program_);
    int unit = 0;
    for (GLint i = 0; i < count; ++i) {
        GLchar text[64];
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(program_, static_cast<GLuint>(i), sizeof text, nullptr, &size, &type, text);
        std::string uniform(text);
        const int location = glGetUniformLocation(program_, text);
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
            locations_.push_back({uniform, is_sampler ? unit++ : location, is_sampler, false});
        }
    }
}

Pass::~Pass() {
    glDeleteProgram(program_);
}

Pass::Pass(Pass&& other) noexcept
    : gpu_(other.gpu_),
      name_(std::move(other.name_)),
      shader_(std::move(other.shader_)),
      target_(other.target_),
      fetches_(other.fetches_),
      program_(std::exchange(other.program_, 0)),
      rect_(other.rect_),
      first_slab_(other.first_slab_),
      locations_(std::move(other.locations_)),
      checked_(other.checked_) {}

Pass::Location* Pass::find(std::string_view name) {
    for (Location& location : locations_)
        if (location.name == name) return &location;
    return nullptr;  // the compiler dropped it: this variant does not need it
}

void Pass::require_all_given() const {
    for (const Location& location : locations_)
        if (!location.given)
            throw GlError(
                fmt::format("{}: uniform '{}' is used but was never given a value", shader_, location.name));
}

void Pass::draw(const std::vector<Input>& inputs, const std::vector<Uniform>& uniforms,
                const std::vector<const Texture*>& outputs, const Region& region) {
    glBindFramebuffer(GL_FRAMEBUFFER, gpu_->framebuffer(outputs));
    const glm::ivec2 size = outputs[0]->size();
    glViewport(0, 0, size.x, size.y);
    glUseProgram(program_);
    for (const Input& input : inputs) {
        Location* sampler = find(input.name);
        if (!sampler) continue;
        sampler->given = true;
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(sampler->location));
        glBindTexture(GL_TEXTURE_2D, input.texture->id());
    }
    for (const Uniform& uniform : uniforms) {
        Location* location = find(uniform.name);
        if (!location) continue;
        location->given = true;
        std::visit(SetUniform{location->location}, uniform.value);
    }
    if (!checked_) {
        require_all_given();
        checked_ = true;
    }

    int draws = 0;
    std::int64_t texels = 0;
    if (region.is_everything()) {
        glUniform4i(rect_, 0, 0, 2 * size.x, 2 * size.y);
        glUniform1i(first_slab_, 0);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        ++draws;
        texels = std::int64_t{size.x} * size.y;
    }
    for (const Box& wanted : region.boxes()) {
        const Box box = wanted.intersect({glm::ivec3(0), target_.size});
        if (box.empty()) continue;
        glUniform4i(rect_, box.lo.x, box.lo.y, box.hi.x, box.hi.y);
        glUniform1i(first_slab_, box.lo.z);
        const glm::ivec3 extent = box.hi - box.lo;
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, extent.z);
        ++draws;
        texels += std::int64_t{extent.x} * extent.y * extent.z;
    }
    if (gpu_->recording()) {
        PassRecord record;
        record.pass = name_;
        for (const Input& input : inputs)
            if (find(input.name)) record.inputs.emplace_back(input.name);
        for (const Uniform& uniform : uniforms)
            if (find(uniform.name)) record.uniforms.emplace_back(uniform.name);
        record.outputs = outputs;
        record.draws = draws;
        record.texels = texels;
        for (const Texture* texture : outputs)
            record.bytes += texels * static_cast<std::int64_t>(bytes_per_texel(texture->format()));
        record.fetches = texels * fetches_;
        gpu_->note(std::move(record));
    }
}

}  // namespace eddy::gles
