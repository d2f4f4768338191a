#include "gles/render/renderer.h"

#include <algorithm>

#include <GLES3/gl3.h>
#include <fmt/format.h>

namespace eddy::gles {
namespace {

glm::ivec3 half(const glm::ivec3& n) {
    return (n + 1) / 2;
}
AtlasLayout pixels(const glm::ivec2& size) {
    return {{size, 1}, 1};
}

/// What the passes of this scene are compiled with.
Variant scene_variant(const FluidSetup& fluid) {
    Variant v{
        .layouts = {{"SMOKE_CELLS", Cells::layout(fluid.cells)}, {"LIGHT", Cells::layout(half(fluid.cells))}},
        .defines = {{"CELLS", glsl(fluid.cells)}}};
    if (fluid.smoke) v.defines.emplace_back("SMOKE", "");
    if (!fluid.bodies.empty()) {
        v.defines.emplace_back("BODY", "");
        v.declarations = shape_declarations(fluid.bodies);
    }
    return v;
}

}  // namespace

Renderer::Renderer(Gpu& gpu, const FluidSetup& fluid, const RenderSetup& setup)
    : gpu_(gpu),
      setup_(setup),
      cell_m_(fluid.cell_m),
      march_size_(setup.half_resolution ? glm::ivec2((setup.width_px + 1) / 2, (setup.height_px + 1) / 2)
                                        : glm::ivec2(setup.width_px, setup.height_px)),
      body_uniforms_(gpu, fluid.bodies, fluid.cell_m),
      light_(gpu, half(fluid.cells), Format::RG32F),
      picture_(gpu.textures().lease({setup.width_px, setup.height_px}, Format::RGBA8)),
      draw_light_(gpu, "light", "gles/render/light.frag", light_.layout(), scene_variant(fluid)),
      draw_picture_(gpu, "picture", "gles/render/picture.frag", pixels(picture_.get()->size()),
                    scene_variant(fluid)) {
    if (!fluid.smoke) return;
    pair_smoke_.emplace(gpu, "pair smoke", "gles/render/pair_smoke.frag", Cells::layout(fluid.cells),
                        Variant{});
    pair_light_.emplace(gpu, "pair light", "gles/render/pair_light.frag", light_.layout(), Variant{});
    march_smoke_.emplace(gpu, "smoke", "gles/render/smoke.frag", pixels(march_size_), scene_variant(fluid));
}

void Renderer::draw(const Fluid& fluid, const std::vector<BodyState>& bodies) {
    const glm::ivec3 n = fluid.setup().cells;
    const Camera camera{setup_.azimuth_deg, setup_.elevation_deg, setup_.distance};
    const double aspect = static_cast<double>(setup_.width_px) / setup_.height_px;
    body_uniforms_.set(bodies);
    const glm::dvec3 to_key = glm::normalize(setup_.to_key);
    // The fill light comes from the other side, lower and from the front.
    const glm::dvec3 to_fill(-to_key.x, 0.5 * std::abs(to_key.y) + 0.1, std::abs(to_key.x) + 0.1);
    std::vector<Uniform> uniforms{
        {"to_key", glm::vec3(to_key)},
        {"to_fill", glm::vec3(glm::normalize(to_fill))},
        {"extinction", static_cast<float>(setup_.optical_density_1_m * cell_m_)},
        {"eye", glm::vec3(camera.eye(glm::dvec3(n)))},
        {"rays", glm::mat3(camera.rays(aspect))},
        {"step_length", static_cast<float>(glm::length(glm::dvec3(n)) / setup_.steps)},
        {"smoke_colour", glm::vec3(setup_.smoke_colour)},
        {"background_colour", glm::vec3(setup_.background_colour)},
        {"exposure", static_cast<float>(setup_.exposure)},
        {"pixel_angle",
         static_cast<float>(glm::radians(camera.field_deg) / std::min(setup_.width_px, setup_.height_px))}};
    const std::vector<Uniform> of_bodies = body_uniforms_.uniforms();
    uniforms.insert(uniforms.end(), of_bodies.begin(), of_bodies.end());
    const std::vector<Input>& body_inputs = body_uniforms_.inputs();
    std::vector<Input> inputs = body_inputs;
    inputs.push_back({"light", &light_.texture()});

    if (!march_smoke_) {
        {
            Gpu::Stage stage(gpu_, "light");
            draw_light_.draw(body_inputs, uniforms, {&light_.texture()});
        }
        Gpu::Stage stage(gpu_, "render");
        draw_picture_.draw(inputs, uniforms, {&*picture_});
        return;
    }

    Field<Cells> smoke_pair(gpu_, n, Format::RG32F), light_pair(gpu_, light_.cells(), Format::RGBA32F);
    {
        Gpu::Stage stage(gpu_, "light");
        const Input smoke{"smoke", &fluid.smoke()->texture()};
        std::vector<Input> seen = body_inputs;
        seen.push_back(smoke);
        draw_light_.draw(seen, uniforms, {&light_.texture()});
        pair_smoke_->draw({smoke}, {}, {&smoke_pair.texture()});
        pair_light_->draw({{"light", &light_.texture()}}, {}, {&light_pair.texture()});
    }
    Gpu::Stage stage(gpu_, "render");
    const TexturePool::Lease front = gpu_.textures().lease(march_size_, Format::RGBA16F);
    TexturePool::Lease behind;
    std::vector<const Texture*> layers{&*front};
    inputs.push_back({"front", &*front});
    if (!bodies.empty()) {
        behind = gpu_.textures().lease(march_size_, Format::RGBA16F);
        layers.push_back(&*behind);
        inputs.push_back({"behind", &*behind});
    }
    std::vector<Input> marched = body_inputs;
    marched.insert(marched.end(), {{"smoke", &smoke_pair.texture()}, {"light", &light_pair.texture()}});
    march_smoke_->draw(marched, uniforms, layers);
    draw_picture_.draw(inputs, uniforms, {&*picture_});
}

}  // namespace eddy::gles
