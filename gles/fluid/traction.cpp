#include "gles/fluid/traction.h"

#include <fmt/format.h>

#include "gles/fluid/results.h"

namespace eddy::gles {

std::vector<int> parts_asked_for(const BodySetup& body, Variant& variant) {
    std::vector<int> parts;
    const auto add = [&](const char* name, int part) {
        variant.defines.emplace_back(name, fmt::format("{}", parts.size()));
        parts.push_back(part);
    };
    if (body.force) add("FORCE", 0);
    if (body.torque) add("TORQUE", 1);
    return parts;
}

Traction::Traction(Gpu& gpu, const FluidSetup& setup, int target_width) : gpu_(&gpu), cell_m_(setup.cell_m) {
    const glm::ivec3& n = setup.cells;
    const Variant every{
        .layouts = {{"PHI", Cells4::layout(n)}, {"FRACTION", Faces4::layout(n)}, {"FACES", Faces::layout(n)}},
        .defines = {{"CELLS", glsl(n)}},
        .declarations = shape_declarations(setup.bodies)};
    for (std::size_t i = 0; i < setup.bodies.size(); ++i) {
        const BodySetup& body = setup.bodies[i];
        if (!body.force && !body.torque) continue;
        Variant variant = every;
        if (setup.viscosity_pa_s > 0.0) variant.defines.emplace_back("VISCOUS", "");
        const std::vector<int> parts = parts_asked_for(body, variant);
        const glm::ivec2 columns(largest_body_box(body, setup.cell_m, n));
        const AtlasLayout layout{{columns.x, columns.y, 1}, 1};
        bodies_.push_back(
            {static_cast<int>(i), parts, columns,
             Pass(gpu, fmt::format("traction {}", i), "gles/fluid/traction.frag", layout, variant),
             Reduce(gpu, fmt::format("sum traction {}", i), columns, {target_width, 1})});
    }
}

void Traction::draw(const Field<Cells4>& phi, const FaceFractions& a, const BodyUniforms& uniforms,
                    const std::vector<BodyState>& states, const std::vector<Box>& boxes,
                    const Texture& target, const std::optional<Friction>& friction, int first) {
    std::vector<Input> inputs = a.inputs();
    inputs.push_back({"phi", &phi.texture()});
    inputs.insert(inputs.end(), uniforms.inputs().begin(), uniforms.inputs().end());
    std::vector<Uniform> values = uniforms.uniforms();
    if (friction) {
        inputs.push_back({"velocity", &friction->velocity.texture()});
        const Grip::Level& grip = friction->grip.level(0);
        inputs.insert(inputs.end(), {{"distances", &grip.distances.texture()},
                                     {"grips", &grip.grips.texture()},
                                     {"surface", &friction->grip.surface().texture()}});
        values.push_back({"lambda", friction->lambda});
    }
    for (Body& body : bodies_) {
        std::vector<TexturePool::Lease> sums;
        std::vector<const Texture*> outputs;
        for (std::size_t i = 0; i < body.parts.size(); ++i) {
            sums.push_back(gpu_->textures().lease(body.columns, Format::RGBA32F));
            outputs.push_back(sums.back().get());
        }
        const auto index = static_cast<std::size_t>(body.index);
        const Box& box = boxes[index];
        std::vector<Uniform> of_body = values;
        of_body.insert(of_body.end(), {{"box_low", glm::ivec3(box.lo.x, box.lo.y, box.lo.z / 4)},
                                       {"box_high", glm::ivec3(box.hi.x, box.hi.y, (box.hi.z + 3) / 4)},
                                       {"pivot", glm::vec3(states[index].centre_m / cell_m_)},
                                       {"body", body.index}});
        body.sum_columns.draw(inputs, of_body, outputs);
        const glm::ivec2 to = Results::load_texel(body.index) + glm::ivec2(first, 0);
        for (std::size_t i = 0; i < sums.size(); ++i)
            body.reduce.draw(*sums[i], target, to + glm::ivec2(body.parts[i], 0));
    }
}

}  // namespace eddy::gles
