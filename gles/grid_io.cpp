#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// Calls f(index in the array, texel number in the atlas) for each index of the layout.
template <class F>
void for_each_texel(const AtlasLayout& layout, F f) {
    std::size_t i = 0;
    for (int z = 0; z < layout.size.z; ++z)
        for (int y = 0; y < layout.size.y; ++y)
            for (int x = 0; x < layout.size.x; ++x) {
                const glm::ivec2 t = layout.texel({x, y, z});
                f(i++, static_cast<std::size_t>(t.y * layout.texels().x + t.x));
            }
}

std::size_t texel_count(const AtlasLayout& layout) {
    return static_cast<std::size_t>(layout.texels().x * layout.texels().y);
}

/// Calls f(index in the array, texel number, channel) for each cell of an n grid stored four layers a texel.
template <class F>
void for_each_of_four(const AtlasLayout& layout, const glm::ivec3& n, F f) {
    std::size_t i = 0;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x) {
                const glm::ivec2 t = layout.texel({x, y, z / 4});
                f(i++, static_cast<std::size_t>(t.y * layout.texels().x + t.x), z % 4);
            }
}

}  // namespace

std::vector<glm::vec4> unpack_texels(const std::vector<glm::vec4>& texels, const AtlasLayout& layout) {
    std::vector<glm::vec4> values(static_cast<std::size_t>(layout.size.x * layout.size.y * layout.size.z));
    for_each_texel(layout, [&](std::size_t i, std::size_t t) { values[i] = texels[t]; });
    return values;
}

std::vector<glm::vec3> unpack_vectors(const std::vector<glm::vec4>& texels, const AtlasLayout& layout) {
    std::vector<glm::vec3> values(static_cast<std::size_t>(layout.size.x * layout.size.y * layout.size.z));
    for_each_texel(layout, [&](std::size_t i, std::size_t t) { values[i] = glm::vec3(texels[t]); });
    return values;
}

std::vector<glm::vec4> pack_vectors(const std::vector<glm::vec3>& values, const AtlasLayout& layout) {
    std::vector<glm::vec4> texels(texel_count(layout), glm::vec4(0.0f));
    for_each_texel(layout, [&](std::size_t i, std::size_t t) { texels[t] = glm::vec4(values[i], 0.0f); });
    return texels;
}

std::vector<float> pack_scalars(const std::vector<float>& values, const AtlasLayout& layout) {
    std::vector<float> texels(texel_count(layout), 0.0f);
    for_each_texel(layout, [&](std::size_t i, std::size_t t) { texels[t] = values[i]; });
    return texels;
}

std::vector<float> unpack_scalars(const std::vector<glm::vec4>& texels, const AtlasLayout& layout) {
    std::vector<float> values(static_cast<std::size_t>(layout.size.x * layout.size.y * layout.size.z));
    for_each_texel(layout, [&](std::size_t i, std::size_t t) { values[i] = texels[t].x; });
    return values;
}

std::vector<float> unpack_four(const std::vector<glm::vec4>& texels, const AtlasLayout& layout,
                               const glm::ivec3& n) {
    std::vector<float> values(static_cast<std::size_t>(n.x * n.y * n.z));
    for_each_of_four(layout, n,
                     [&](std::size_t i, std::size_t t, int channel) { values[i] = texels[t][channel]; });
    return values;
}

std::vector<glm::vec4> pack_four(const std::vector<float>& values, const AtlasLayout& layout,
                                 const glm::ivec3& n) {
    std::vector<glm::vec4> texels(texel_count(layout), glm::vec4(0.0f));
    for_each_of_four(layout, n,
                     [&](std::size_t i, std::size_t t, int channel) { texels[t][channel] = values[i]; });
    return texels;
}

void clear(Texture& texture) {
    const std::vector<float> zeros(4 * static_cast<std::size_t>(texture.size().x * texture.size().y));
    texture.upload(zeros.data());
}

}  // namespace eddy::gles
