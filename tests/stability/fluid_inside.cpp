#include "tests/stability/fluid_inside.h"

#include <cmath>

namespace eddy::gles {
namespace {

struct Inside : Fluid {
    using Fluid::state;
};

}  // namespace

FluidState inside(const Fluid& fluid) {
    return (fluid.*(&Inside::state))();
}

void poison(const Texture& texture, const glm::ivec2& texel, float value) {
    std::vector<glm::vec4> texels = texture.download();
    texels.at(static_cast<std::size_t>(texel.y * texture.size().x + texel.x)) = glm::vec4(value);
    auto& written = const_cast<Texture&>(texture);
    if (texture.format() == Format::RGBA32F) return written.upload(&texels[0].x);
    std::vector<float> first;
    for (const glm::vec4& t : texels) first.push_back(t.x);
    written.upload(first.data());
}

long not_finite(const Texture& texture) {
    long count = 0;
    const bool one = texture.format() == Format::R32F;
    for (const glm::vec4& t : texture.download())
        for (int c = 0; c < (one ? 1 : 4); ++c) count += std::isfinite(t[c]) ? 0 : 1;
    return count;
}

long not_finite(const Fluid& fluid) {
    const FluidState s = inside(fluid);
    long count = 0;
    const auto look = [&](const auto* field) {
        if (field && *field) count += not_finite(field->texture());
    };
    look(s.on_faces);
    look(s.at_centres);
    look(s.phi4);
    look(s.phi);
    look(s.smoke);
    look(s.temperature);
    look(s.diffused);
    return count;
}

}  // namespace eddy::gles
