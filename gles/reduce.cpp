#include "gles/reduce.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy::gles {
namespace {

AtlasLayout flat(const glm::ivec2& size) {
    return {{size.x, size.y, 1}, 1};
}

int block_of(const glm::ivec2& source) {
    return std::max(
        1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(std::max(source.x, source.y))))));
}

Variant variant(const glm::ivec2& source, int block, const std::string& mask) {
    Variant v;
    v.defines = {{"BLOCK", fmt::format("{}", block)},
                 {"SOURCE_SIZE", fmt::format("ivec2({}, {})", source.x, source.y)}};
    if (!mask.empty()) v.defines.emplace_back("MASK", mask);
    return v;
}

}  // namespace

Reduce::Reduce(Gpu& gpu, const std::string& name, const glm::ivec2& source, const glm::ivec2& target,
               const std::string& mask)
    : middle_size_((source + block_of(source) - 1) / block_of(source)),
      gpu_(&gpu),
      blocks_(gpu, name + " blocks", "gles/reduce.frag", flat(middle_size_),
              variant(source, block_of(source), mask)),
      rest_(gpu, name, "gles/reduce.frag", flat(target),
            variant(middle_size_, std::max(middle_size_.x, middle_size_.y), mask)) {}

void Reduce::draw(const Texture& source, const Texture& target, const glm::ivec2& to) {
    const TexturePool::Lease middle = gpu_->textures().lease(middle_size_, Format::RGBA32F);
    blocks_.draw({{"field", &source}}, {{"shift", glm::ivec3(0)}}, {&*middle});
    rest_.draw({{"field", &*middle}}, {{"shift", glm::ivec3(to, 0)}}, {&target},
               Region({Box{{to.x, to.y, 0}, {to.x + 1, to.y + 1, 1}}}));
}

}  // namespace eddy::gles
