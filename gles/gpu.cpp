#include "gles/gpu.h"

#include <GLES3/gl3.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace eddy::gles {
namespace {

using namespace std::chrono_literals;

/// Of a wait, between two pauses.
constexpr std::chrono::nanoseconds kSlice = 100ms;

}  // namespace

void finish() {
    glFinish();
}

Gpu::Gpu(const Capabilities& capabilities)
    : capabilities_(capabilities),
      filters_float_(capabilities.filters_float),
      textures_(capabilities.filters_float) {
    // Passes make their corners from gl_VertexID: no attributes, but ES 3 wants an array object all the same.
    glGenVertexArrays(1, &vertex_array_);
    glBindVertexArray(vertex_array_);
    glDisable(GL_DITHER);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
}

Gpu::~Gpu() {
    for (const auto& [attachments, framebuffer] : framebuffers_) glDeleteFramebuffers(1, &framebuffer);
    glDeleteVertexArrays(1, &vertex_array_);
}

unsigned Gpu::framebuffer(const std::vector<const Texture*>& targets) {
    std::vector<std::uint64_t> key;
    for (const Texture* texture : targets) key.push_back(texture->serial());
    if (auto it = framebuffers_.find(key); it != framebuffers_.end()) return it->second;

    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    std::vector<GLenum> buffers;
    for (std::size_t i = 0; i < key.size(); ++i) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, targets[i]->id(), 0);
        buffers.push_back(attachment);
    }
    glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
    if (const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
        throw GlError(fmt::format("{} refuses to draw into {} {} texture(s): framebuffer status {:#06x}",
                                  capabilities_.renderer, targets.size(), to_string(targets[0]->format()),
                                  status));
    return framebuffers_[key] = framebuffer;
}

void Gpu::free_idle_textures() {
    const std::vector<std::unique_ptr<Texture>> idle = textures_.take_idle();
    std::set<std::uint64_t> gone;
    for (const auto& texture : idle) gone.insert(texture->serial());
    // A framebuffer keeps the memory of what is attached to it.
    std::erase_if(framebuffers_, [&](const auto& entry) {
        const auto& [serials, framebuffer] = entry;
        const bool holds_one =
            std::any_of(serials.begin(), serials.end(), [&](std::uint64_t s) { return gone.contains(s); });
        if (holds_one) glDeleteFramebuffers(1, &framebuffer);
        return holds_one;
    });
}

void Gpu::pause(Next next) {
    may_compile_ |= next == Next::Compiling;
    if (!between_ || pauses_) return;
    struct Within {
        explicit Within(bool& flag) : flag_(flag) { flag_ = true; }
        ~Within() { flag_ = false; }
        bool& flag_;
    } within(pauses_);
    between_(next);
}

void Gpu::finish() {
    struct Fence {
        const GLsync sync = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        ~Fence() { glDeleteSync(sync); }
    } fence;
    // Without a fence, or with one that does not pass, it is the driver's affair, and that of whoever watches this program.
    if (!fence.sync || !wait(fence.sync, patience())) glFinish();
    may_compile_ = false;
}

bool Gpu::wait(void* fence, std::chrono::nanoseconds patience) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + patience;
    for (;;) {
        const auto slice = std::clamp<std::chrono::nanoseconds>(end - Clock::now(), 0ns, kSlice);
        const GLenum state = glClientWaitSync(static_cast<GLsync>(fence), GL_SYNC_FLUSH_COMMANDS_BIT,
                                              static_cast<GLuint64>(slice.count()));
        if (state != GL_TIMEOUT_EXPIRED) return state != GL_WAIT_FAILED;
        if (Clock::now() >= end) return false;
        pause();
    }
}

Gpu::Stage::Stage(Gpu& gpu, std::string_view name) : gpu_(gpu), outer_(gpu.stage_) {
    gpu_.pause();
    gpu_.stage_ = name;
    if (gpu_.watcher_) gpu_.watcher_(name, true);
}

Gpu::Stage::~Stage() {
    if (gpu_.watcher_) gpu_.watcher_(gpu_.stage_, false);
    gpu_.stage_ = outer_;
}

void Gpu::note(PassRecord record) {
    if (!records_) return;
    record.stage = stage_;
    records_->push_back(std::move(record));
}

}  // namespace eddy::gles
