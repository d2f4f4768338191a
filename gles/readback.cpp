#include "gles/readback.h"

#include <GLES3/gl3.h>

#include <cstring>

namespace eddy::gles {
namespace {

constexpr std::chrono::seconds kPatience{10};
/// Drivers may compile a pass when it is first drawn, and the first answer comes after all of them: with Mesa's zink over
/// lavapipe, 20 s on a busy machine of two cores.
constexpr std::chrono::seconds kFirstPatience = Gpu::kPatience;

}  // namespace

Readback::Readback(Gpu& gpu, const glm::ivec2& size) : gpu_(&gpu), size_(size) {
    for (Slot& slot : slots_) {
        glGenBuffers(1, &slot.buffer);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, slot.buffer);
        glBufferData(GL_PIXEL_PACK_BUFFER, GLsizeiptr{size.x} * size.y * 16, nullptr, GL_STREAM_READ);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

Readback::~Readback() {
    for (Slot& slot : slots_) {
        if (slot.fence) glDeleteSync(static_cast<GLsync>(slot.fence));
        glDeleteBuffers(1, &slot.buffer);
    }
}

void Readback::request(const Texture& texture, long tag) {
    if (under_way_ == slots_.size()) take(true);  // the newest wins over the oldest
    Slot& slot = slots_[(first_ + under_way_++) % slots_.size()];
    glBindFramebuffer(GL_FRAMEBUFFER, gpu_->framebuffer({&texture}));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, slot.buffer);
    glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    slot.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    slot.tag = tag;
    glFlush();  // or the fence may never be reached
}

std::optional<Readback::Result> Readback::take(bool wait) {
    if (under_way_ == 0) return std::nullopt;
    Slot& slot = slots_[first_];
    bool done = false;
    if (wait) {
        done = gpu_->wait(slot.fence, answered_ ? kPatience : kFirstPatience);
    } else {
        const GLenum state = glClientWaitSync(static_cast<GLsync>(slot.fence), GL_SYNC_FLUSH_COMMANDS_BIT, 0);
        if (state == GL_TIMEOUT_EXPIRED) return std::nullopt;
        done = state != GL_WAIT_FAILED;
    }
    glDeleteSync(static_cast<GLsync>(slot.fence));
    slot.fence = nullptr;
    first_ = (first_ + 1) % slots_.size();
    --under_way_;

    if (!done) {
        ++failures_;
        return std::nullopt;
    }
    answered_ = true;
    const std::size_t count = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
    Result result{slot.tag, std::vector<glm::vec4>(count)};
    glBindBuffer(GL_PIXEL_PACK_BUFFER, slot.buffer);
    const GLsizeiptr bytes = static_cast<GLsizeiptr>(count * sizeof(glm::vec4));
    const void* mapped = glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0, bytes, GL_MAP_READ_BIT);
    if (mapped) {
        std::memcpy(result.texels.data(), mapped, count * sizeof(glm::vec4));
        glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    if (mapped) return result;
    ++failures_;
    return std::nullopt;
}

}  // namespace eddy::gles
