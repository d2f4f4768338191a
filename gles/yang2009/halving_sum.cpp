#include "gles/yang2009/halving_sum.h"

#include <fmt/format.h>

namespace eddy::gles {

HalvingSum::HalvingSum(Gpu& gpu, const std::string& name, const glm::ivec3& cells, int target_width)
    : gpu_(&gpu) {
    glm::ivec3 source = cells;
    do {
        const glm::ivec3 half = (source + 1) / 2;
        const AtlasLayout target =
            half == glm::ivec3(1) ? AtlasLayout{{target_width, 1, 1}, 1} : Cells::layout(half);
        passes_.emplace_back(gpu, fmt::format("{} {}", name, passes_.size()), "gles/yang2009/halve.frag",
                             target, Variant{.layouts = {{"SOURCE", Cells::layout(source)}}});
        grids_.push_back(half);
        source = half;
    } while (source != glm::ivec3(1));
}

void HalvingSum::draw(const Texture& source, const Texture& target, int to) {
    const Texture* field = &source;
    Field<Cells> sum;
    for (std::size_t i = 0; i + 1 < passes_.size(); ++i) {
        Field<Cells> next(*gpu_, grids_[i], Format::RGBA32F);
        passes_[i].draw({{"field", field}}, {{"shift", glm::ivec3(0)}}, {&next.texture()});
        sum = std::move(next);
        field = &sum.texture();
    }
    const glm::ivec3 texel(to, 0, 0);
    passes_.back().draw({{"field", field}}, {{"shift", texel}}, {&target}, Region({Box{texel, texel + 1}}));
}

}  // namespace eddy::gles
