#pragma once
#include <vector>

#include "gles/atlas.h"
#include "gles/texture.h"

namespace eddy::gles {

// Grids on the CPU are plain arrays, x fastest, then y, then z; these turn them into texels of an atlas and
// back.

/// One texel for each index of the layout.
std::vector<glm::vec4> unpack_texels(const std::vector<glm::vec4>& texels, const AtlasLayout& layout);
std::vector<glm::vec3> unpack_vectors(const std::vector<glm::vec4>& texels, const AtlasLayout& layout);
std::vector<glm::vec4> pack_vectors(const std::vector<glm::vec3>& values, const AtlasLayout& layout);
/// For textures of one channel.
std::vector<float> pack_scalars(const std::vector<float>& values, const AtlasLayout& layout);
std::vector<float> unpack_scalars(const std::vector<glm::vec4>& texels, const AtlasLayout& layout);
/// Four consecutive z in one texel; `n` is the grid without padding.
std::vector<float> unpack_four(const std::vector<glm::vec4>& texels, const AtlasLayout& layout,
                               const glm::ivec3& n);
std::vector<glm::vec4> pack_four(const std::vector<float>& values, const AtlasLayout& layout,
                                 const glm::ivec3& n);

/// Writes zeros into the whole texture.
void clear(Texture& texture);

}  // namespace eddy::gles
