#include "gles/texture.h"

#include <GLES3/gl3.h>
#include <fmt/format.h>

#include <utility>

#include "gles/context.h"

namespace eddy::gles {
namespace {

struct FormatRow {
    GLenum internal, external, type;
    std::size_t bytes;
    int channels;
    const char* name;
};

std::uint64_t g_textures_made = 0;  // GL thread only

const FormatRow& row(Format format) {
    static constexpr FormatRow kRows[] = {
        {GL_R32F, GL_RED, GL_FLOAT, 4, 1, "R32F"},
        {GL_RG32F, GL_RG, GL_FLOAT, 8, 2, "RG32F"},
        {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16, 4, "RGBA32F"},
        {GL_R16F, GL_RED, GL_FLOAT, 2, 1, "R16F"},
        {GL_RGBA16F, GL_RGBA, GL_FLOAT, 8, 4, "RGBA16F"},
        {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4, "RGBA8"},
    };
    return kRows[static_cast<std::size_t>(format)];
}

}  // namespace

std::size_t bytes_per_texel(Format format) {
    return row(format).bytes;
}
const char* to_string(Format format) {
    return row(format).name;
}

Texture::Texture(const glm::ivec2& size, Format format, bool linear)
    : serial_(++g_textures_made), size_(size), format_(format) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (size.x > limit || size.y > limit)
        throw GlError(fmt::format(
            "the grid needs a texture of {} x {} texels; this driver's limit is {}. Use fewer cells", size.x,
            size.y, limit));
    glGenTextures(1, &id_);
    glBindTexture(GL_TEXTURE_2D, id_);
    glTexStorage2D(GL_TEXTURE_2D, 1, row(format).internal, size.x, size.y);
    const GLint filter = linear ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (glGetError() == GL_OUT_OF_MEMORY)
        throw GlError(
            fmt::format("out of GPU memory for a {} texture of {} x {}", to_string(format), size.x, size.y));
}

Texture::~Texture() {
    glDeleteTextures(1, &id_);
}

std::size_t Texture::bytes() const {
    return row(format_).bytes * static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
}

void Texture::upload(const float* texels) {
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.x, size_.y, row(format_).external, GL_FLOAT, texels);
}

void Texture::upload(const std::uint8_t* texels) {
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

std::vector<glm::vec4> Texture::download() const {
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, id_, 0);
    const std::size_t count = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
    std::vector<glm::vec4> texels(count);
    glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, texels.data());
    glDeleteFramebuffers(1, &framebuffer);
    return texels;
}

TexturePool::Lease& TexturePool::Lease::operator=(Lease&& other) noexcept {
    if (this != &other) {
        give_back();
        pool_ = other.pool_;
        texture_ = std::move(other.texture_);
    }
    return *this;
}

void TexturePool::Lease::give_back() {
    if (texture_) pool_->idle_.push_back(std::move(texture_));
}

TexturePool::Lease TexturePool::lease(const glm::ivec2& size, Format format) {
    for (auto it = idle_.rbegin(); it != idle_.rend(); ++it) {
        if ((*it)->size() != size || (*it)->format() != format) continue;
        std::unique_ptr<Texture> texture = std::move(*it);
        idle_.erase(std::next(it).base());
        return {this, std::move(texture)};
    }
    const bool is_half = format == Format::R16F || format == Format::RGBA16F || format == Format::RGBA8;
    auto texture = std::make_unique<Texture>(size, format, is_half || filters_float_);
    ++made_;
    bytes_ += texture->bytes();
    return {this, std::move(texture)};
}

std::vector<std::unique_ptr<Texture>> TexturePool::take_idle() {
    for (const auto& texture : idle_) bytes_ -= texture->bytes();
    return std::exchange(idle_, {});
}

}  // namespace eddy::gles
