#include "gles/row_sum.h"

#include <fmt/format.h>

#include <utility>

namespace eddy::gles {
namespace {

constexpr int kRun = 8;

Variant with_run(Variant variant) {
    variant.defines.emplace_back("RUN", fmt::format("{}", kRun));
    return variant;
}

}  // namespace

RowSum::RowSum(Gpu& gpu, const std::string& name, std::string_view shader, const glm::ivec3& texels,
               Variant variant, const glm::ivec2& target, const std::string& mask)
    : gpu_(&gpu),
      runs_(AtlasLayout::tile({(texels.x + kRun - 1) / kRun, texels.y, texels.z})),
      look_(gpu, name, shader, runs_, with_run(std::move(variant))),
      sum_(gpu, "reduce " + name, runs_.texels(), target, mask) {}

void RowSum::draw(const std::vector<Input>& inputs, const std::vector<Uniform>& uniforms,
                  const Texture& target, const glm::ivec2& to) {
    const TexturePool::Lease runs = gpu_->textures().lease(runs_.texels(), Format::RGBA32F);
    look_.draw(inputs, uniforms, {&*runs});
    sum_.draw(*runs, target, to);
}

}  // namespace eddy::gles
