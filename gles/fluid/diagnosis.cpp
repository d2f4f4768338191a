#include "gles/fluid/diagnosis.h"

#include "gles/fluid/results.h"

namespace eddy::gles {

void Diagnosis::make(const Tank& tank) {
    const glm::ivec3 n = setup_->cells;
    Variant variant{.layouts = {{"FACES", Faces::layout(n)}, {"PHI", Cells4::layout(n)}},
                    .defines = {{"CELLS", glsl(n)}}};
    if (tank.smoke || tank.temperature) variant.layouts.emplace_back("SCALARS", Cells::layout(n));
    if (tank.smoke) variant.defines.emplace_back("SMOKE", "");
    if (tank.temperature) variant.defines.emplace_back("TEMPERATURE", "");
    columns_.emplace(*gpu_, "diagnose", "gles/fluid/diagnose.frag", AtlasLayout{{n.x, n.y, 1}, 1}, variant);
    const glm::ivec2 row(Results::width(*setup_), 1);
    sum_.emplace(*gpu_, "reduce diagnosis", glm::ivec2(n), row, "vec4(1.0, 0.0, 0.0, 1.0)");
    if (tank.temperature) sum_heat_.emplace(*gpu_, "reduce heat", glm::ivec2(n), row);
}

void Diagnosis::draw(const Tank& tank, const Texture& row) {
    if (!columns_) make(tank);
    const glm::ivec2 columns(setup_->cells);
    std::vector<Input> inputs{{"velocity", &tank.velocity.texture()},
                              {"divergence", &tank.after.texture()},
                              {"before", &tank.before.texture()}};
    if (tank.smoke) inputs.push_back({"smoke", &tank.smoke->texture()});
    if (tank.temperature) inputs.push_back({"temperature", &tank.temperature->texture()});
    const TexturePool::Lease flow = gpu_->textures().lease(columns, Format::RGBA32F);
    if (!tank.temperature) {
        columns_->draw(inputs, {}, {&*flow});
    } else {
        const TexturePool::Lease heat = gpu_->textures().lease(columns, Format::RGBA32F);
        columns_->draw(inputs, {}, {&*flow, &*heat});
        sum_heat_->draw(*heat, row, Results::heat_texel(*setup_));
    }
    sum_->draw(*flow, row, Results::diagnosis_texel(*setup_));
}

}  // namespace eddy::gles
