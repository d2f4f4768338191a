#include "firmware/stability/fault.h"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace eddy::stability {
namespace {

using gles::AtlasLayout;

/// A fluid shows nobody its state but another fluid.
struct Inside : gles::Fluid {
    using gles::Fluid::state;
};
gles::FluidState state_of(const gles::Fluid& fluid) {
    return (fluid.*(&Inside::state))();
}

/// Of the layout that a place is stored in.
AtlasLayout layout_of(const gles::Fluid& fluid, Fault::Place place) {
    const glm::ivec3& cells = fluid.setup().cells;
    switch (place) {
        case Fault::Place::Velocity:
            return state_of(fluid).on_faces ? gles::Faces::layout(cells) : gles::Cells::layout(cells);
        case Fault::Place::Pressure:
            return state_of(fluid).phi4 ? gles::Cells4::layout(cells) : gles::Cells::layout(cells);
        case Fault::Place::Fractions:
            return gles::Faces4::layout(cells);
        case Fault::Place::Smoke:
        case Fault::Place::Temperature:
            break;
    }
    return gles::Cells::layout(cells);
}

bool has(const gles::Fluid& fluid, Fault::Place place) {
    switch (place) {
        case Fault::Place::Velocity:
        case Fault::Place::Pressure:
            break;
        case Fault::Place::Smoke:
            return fluid.smoke() != nullptr;
        case Fault::Place::Temperature:
            return fluid.temperature() != nullptr;
        case Fault::Place::Fractions:
            return !fluid.setup().bodies.empty();
    }
    return true;
}

/// GL's textures are told apart by what may write them; a fault may.
gles::Texture* writable(const gles::Texture* texture) {
    return const_cast<gles::Texture*>(texture);
}

int channels_of(gles::Format format) {
    return format == gles::Format::RGBA32F ? 4 : format == gles::Format::RG32F ? 2 : 1;
}

/// Every channel of every texel, as upload() takes them.
std::vector<float> content_of(const gles::Texture& texture) {
    const int channels = channels_of(texture.format());
    std::vector<float> values;
    for (const glm::vec4& texel : texture.download())
        for (int c = 0; c < channels; ++c) values.push_back(texel[c]);
    return values;
}

}  // namespace

Faults::Faults(gles::Gpu& gpu) : gpu_(gpu) {
    gpu_.record(&passes_);
}

Faults::~Faults() {
    gpu_.record(nullptr);
}

void Faults::begin_step(const gles::Fluid& fluid) {
    fractions_ = fractions_of(fluid);
    passes_.clear();
}

std::vector<gles::Texture*> Faults::fractions_of(const gles::Fluid& fluid) const {
    // The last of the finest grid that a step drew is what lives on to the next.
    const glm::ivec2 texels = layout_of(fluid, Fault::Place::Fractions).texels();
    const auto last = std::find_if(passes_.rbegin(), passes_.rend(), [&](const gles::PassRecord& pass) {
        return pass.stage == "voxelise" && !pass.outputs.empty() && pass.outputs[0]->size() == texels;
    });
    if (last == passes_.rend()) return fractions_;
    std::vector<gles::Texture*> textures;
    for (const gles::Texture* texture : last->outputs) textures.push_back(writable(texture));
    return textures;
}

std::vector<gles::Texture*> Faults::textures_of(const gles::Fluid& fluid, Fault::Place place) const {
    if (place == Fault::Place::Fractions) return fractions_of(fluid);
    const gles::FluidState state = state_of(fluid);
    std::vector<gles::Texture*> textures;
    const auto add = [&](const auto* field) {
        if (field && *field) textures.push_back(writable(&field->texture()));
    };
    switch (place) {
        case Fault::Place::Velocity:
            add(state.on_faces);
            add(state.at_centres);
            break;
        case Fault::Place::Pressure:
            add(state.phi4);
            add(state.phi);
            break;
        case Fault::Place::Smoke:
            add(state.smoke);
            break;
        case Fault::Place::Temperature:
            add(state.temperature);
            break;
        case Fault::Place::Fractions:
            break;
    }
    return textures;
}

void Faults::put(const gles::Fluid& fluid, const Fault& fault) {
    if (!has(fluid, fault.place)) return;
    const std::vector<gles::Texture*> textures = textures_of(fluid, fault.place);
    if (textures.empty()) throw std::logic_error("a fault hits nothing");
    const glm::ivec3 n = fluid.setup().cells;
    const AtlasLayout layout = layout_of(fluid, fault.place);
    // Fractions are drawn anew around bodies; what counts is a place where they are not.
    const glm::ivec3 cell(fault.place == Fault::Place::Fractions ? 1 : n.x / 4, n.y / 2, n.z / 2);
    const bool packed = layout.size.z < n.z;  // four cells a texel
    std::mt19937 random(1);
    std::uniform_real_distribution<float> garbage(-fault.value, fault.value);
    for (gles::Texture* texture : textures) {
        std::vector<float> values = content_of(*texture);
        const auto channels = static_cast<std::size_t>(channels_of(texture->format()));
        const auto width = static_cast<std::size_t>(texture->size().x);
        const auto index = [&](const glm::ivec3& at) {
            const glm::ivec2 texel = layout.texel(at);
            return channels * (width * static_cast<std::size_t>(texel.y) + static_cast<std::size_t>(texel.x));
        };
        switch (fault.extent) {
            case Fault::Extent::Texel:
                for (std::size_t c = 0; c < channels; ++c)
                    values[index({cell.x, cell.y, packed ? cell.z / 4 : cell.z}) + c] = fault.value;
                break;
            case Fault::Extent::Everywhere:
                std::fill(values.begin(), values.end(), fault.value);
                break;
            case Fault::Extent::Garbage:
                for (float& value : values) value = garbage(random);
                break;
            case Fault::Extent::Checkerboard:
                for (int z = 0; z < layout.size.z; ++z)
                    for (int y = 0; y < layout.size.y; ++y)
                        for (int x = 0; x < layout.size.x; ++x)
                            for (std::size_t c = 0; c < channels; ++c)
                                values[index({x, y, z}) + c] +=
                                    (x + y + (packed ? static_cast<int>(c) : z)) % 2 == 0 ? fault.value
                                                                                          : -fault.value;
                break;
        }
        texture->upload(values.data());
    }
}

}  // namespace eddy::stability
