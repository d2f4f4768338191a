#include "gles/yang2009/linear_sum.h"

namespace eddy::gles {
namespace {

/// The atlas may end in tiles that hold no slab: they are left out.
glm::dvec4 total(const std::vector<glm::vec4>& texels, const AtlasLayout& layout) {
    glm::dvec4 sum(0.0);
    for (int z = 0; z < layout.size.z; ++z)
        for (int y = 0; y < layout.size.y; ++y) {
            const glm::ivec2 first = layout.texel({0, y, z});
            const auto row = texels.begin() + first.y * layout.texels().x + first.x;
            for (int x = 0; x < layout.size.x; ++x) sum += glm::dvec4(row[x]);
        }
    return sum;
}

}  // namespace

LinearSum::LinearSum(Gpu& gpu, const std::string& name, const glm::ivec3& cells, int target_width)
    : layout_(Cells::layout(cells)),
      total_(gpu, glm::ivec3(1), Format::RGBA32F),
      place_(gpu, name, glm::ivec3(1), target_width) {}

void LinearSum::draw(const Texture& source, const Texture& target, int to) {
    const glm::vec4 sum(total(source.download(), layout_));
    total_.texture().upload(&sum.x);
    place_.draw(total_.texture(), target, to);
}

}  // namespace eddy::gles
