#include "gles/yang2009/force.h"

#include "gles/fluid/traction.h"

namespace eddy::gles {
namespace {

Variant force_variant(const FluidSetup& setup) {
    Variant variant{.declarations = shape_declarations(setup.bodies)};
    if (setup.viscosity_pa_s > 0.0) variant.defines.emplace_back("VISCOUS", "");
    return variant;
}

std::variant<HalvingSum, LinearSum> make_sum(Gpu& gpu, const FluidSetup& setup, int target_width) {
    if (setup.solver.force_sum == ForceSum::Cpu)
        return LinearSum(gpu, "sum force", setup.cells, target_width);
    return HalvingSum(gpu, "sum force", setup.cells, target_width);
}

}  // namespace

VoxelForce::VoxelForce(Gpu& gpu, const FluidSetup& setup, int target_width)
    : gpu_(&gpu), cell_m_(setup.cell_m), sum_(make_sum(gpu, setup, target_width)) {
    for (std::size_t i = 0; i < setup.bodies.size(); ++i) {
        const BodySetup& body = setup.bodies[i];
        if (!body.force && !body.torque) continue;
        Variant variant = force_variant(setup);
        const std::vector<int> parts = parts_asked_for(body, variant);
        bodies_.push_back(
            {static_cast<int>(i), parts,
             Pass(gpu, "force", "gles/yang2009/force.frag", Cells::layout(setup.cells), variant)});
    }
}

void VoxelForce::draw(const Field<Cells>& phi, const Field<Cells>& star, float diffusion,
                      const Voxels& voxels, const BodyUniforms& uniforms,
                      const std::vector<BodyState>& states, const Texture& target) {
    const auto sum = [&](const Field<Cells>& field, int to) {
        std::visit([&](auto& method) { method.draw(field.texture(), target, to); }, sum_);
    };
    for (Body& body : bodies_) {
        std::vector<Field<Cells>> fields;
        std::vector<const Texture*> outputs;
        for (std::size_t i = 0; i < body.parts.size(); ++i) {
            fields.emplace_back(*gpu_, phi.cells(), Format::RGBA32F);
            outputs.push_back(&fields.back().texture());
        }
        const glm::vec3 pivot(states[static_cast<std::size_t>(body.index)].centre_m / cell_m_);
        std::vector<Input> inputs = uniforms.inputs();
        inputs.insert(
            inputs.end(),
            {{"phi", &phi.texture()}, {"velocity", &star.texture()}, {"obstacles", &voxels.texture()}});
        std::vector<Uniform> values = uniforms.uniforms();
        values.insert(values.end(), {{"pivot", pivot}, {"body", body.index}, {"diffusion", diffusion}});
        body.force.draw(inputs, values, outputs);
        Gpu::Stage stage(*gpu_, "force integral");
        for (std::size_t i = 0; i < fields.size(); ++i) sum(fields[i], 2 * body.index + body.parts[i]);
    }
}

}  // namespace eddy::gles
