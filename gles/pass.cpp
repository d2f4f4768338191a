#include "gles/pass.h"

#include <GLES3/gl3.h>
#include <fmt/format.h>

#include <algorithm>

#include "gles/shader_source.h"

namespace eddy::gles {
namespace {

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
    gpu.pause(Next::Compiling);
    program_ = gpu.programs().get({std::string(shader), switches(gpu, variant), declarations(target, variant),
                                   target.declaration("TARGET")});
}

const Program::Uniform* Pass::find(std::string_view name) const {
    for (const Program::Uniform& uniform : program_->uniforms())
        if (uniform.name == name) return &uniform;
    return nullptr;  // the compiler dropped it: this variant does not need it
}

void Pass::require_all_given(const std::vector<Input>& inputs, const std::vector<Uniform>& uniforms) const {
    for (const Program::Uniform& needed : program_->uniforms()) {
        const auto is_it = [&](const auto& given) { return given.name == needed.name; };
        const bool given = needed.is_sampler ? std::any_of(inputs.begin(), inputs.end(), is_it)
                                             : std::any_of(uniforms.begin(), uniforms.end(), is_it);
        if (!given)
            throw GlError(
                fmt::format("{}: uniform '{}' is used but was not given a value", shader_, needed.name));
    }
}

void Pass::draw(const std::vector<Input>& inputs, const std::vector<Uniform>& uniforms,
                const std::vector<const Texture*>& outputs, const Region& region, Onto onto) {
    if (!checked_) gpu_->pause(Next::Compiling);
    glBindFramebuffer(GL_FRAMEBUFFER, gpu_->framebuffer(outputs));
    const glm::ivec2 size = outputs[0]->size();
    glViewport(0, 0, size.x, size.y);
    glUseProgram(program_->id());
    for (const Input& input : inputs) {
        const Program::Uniform* sampler = find(input.name);
        if (!sampler) continue;
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(sampler->location));
        glBindTexture(GL_TEXTURE_2D, input.texture->id());
    }
    for (const Uniform& uniform : uniforms) {
        if (const Program::Uniform* known = find(uniform.name))
            std::visit(SetUniform{known->location}, uniform.value);
    }
    if (!checked_) {
        require_all_given(inputs, uniforms);
        checked_ = true;
    }

    if (onto == Onto::Over) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    }
    int draws = 0;
    std::int64_t texels = 0;
    if (region.is_everything()) {
        glUniform4i(program_->rect(), 0, 0, 2 * size.x, 2 * size.y);
        glUniform1i(program_->first_slab(), 0);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        ++draws;
        texels = std::int64_t{size.x} * size.y;
    }
    for (const Box& wanted : region.boxes()) {
        const Box box = wanted.intersect({glm::ivec3(0), target_.size});
        if (box.empty()) continue;
        glUniform4i(program_->rect(), box.lo.x, box.lo.y, box.hi.x, box.hi.y);
        glUniform1i(program_->first_slab(), box.lo.z);
        const glm::ivec3 extent = box.hi - box.lo;
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, extent.z);
        ++draws;
        texels += std::int64_t{extent.x} * extent.y * extent.z;
    }
    if (onto == Onto::Over) glDisable(GL_BLEND);
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
