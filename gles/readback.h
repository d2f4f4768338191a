#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gles/gpu.h"

namespace eddy::gles {

/// Brings one small RGBA32F texture to the CPU without waiting: each request copies into a pixel buffer
/// behind a fence, and is picked up when the fence has passed. Up to kMost requests may be under way: one more, and the oldest
/// is dropped unread.
class Readback {
  public:
    static constexpr std::size_t kMost = 3;
    Readback(Gpu& gpu, const glm::ivec2& size);
    ~Readback();
    Readback(const Readback&) = delete;
    Readback& operator=(const Readback&) = delete;

    struct Result {
        long tag;  ///< what the caller gave with the request
        std::vector<glm::vec4> texels;
    };
    /// Asks for the texture's content as it will be after everything drawn so far.
    void request(const Texture& texture, long tag);
    /// The oldest request that is done; with `wait`, waits for the oldest. Nothing if nothing was asked or is done, or
    /// if the GPU lost it, which is counted: a lost answer must not look like an answer of zero.
    std::optional<Result> take(bool wait);
    std::uint64_t failures() const { return failures_; }
    int under_way() const { return static_cast<int>(under_way_); }

  private:
    struct Slot {
        unsigned buffer = 0;
        void* fence = nullptr;
        long tag = 0;
    };
    Gpu* gpu_;
    glm::ivec2 size_;
    std::array<Slot, kMost> slots_;
    std::size_t first_ = 0, under_way_ = 0;
    bool answered_ = false;  // ever
    std::uint64_t failures_ = 0;
};

}  // namespace eddy::gles
