#include "gles/yang2009/force.h"

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
    : gpu_(&gpu),
      cell_m_(setup.cell_m),
      force_(gpu, "force", "gles/yang2009/force.frag", Cells::layout(setup.cells), force_variant(setup)),
      sum_(make_sum(gpu, setup, target_width)) {
    for (std::size_t i = 0; i < setup.bodies.size(); ++i)
        if (setup.bodies[i].force || setup.bodies[i].torque) measured_.push_back(static_cast<int>(i));
}

void VoxelForce::draw(const Field<Cells>& phi, const Field<Cells>& star, float diffusion,
                      const Voxels& voxels, const BodyUniforms& uniforms,
                      const std::vector<BodyState>& states, const Texture& target) {
    const auto sum = [&](const Field<Cells>& field, int to) {
        std::visit([&](auto& method) { method.draw(field.texture(), target, to); }, sum_);
    };
    for (int body : measured_) {
        const Field<Cells> force(*gpu_, phi.cells(), Format::RGBA32F),
            moment(*gpu_, phi.cells(), Format::RGBA32F);
        const glm::vec3 pivot(states[static_cast<std::size_t>(body)].centre_m / cell_m_);
        std::vector<Input> inputs = uniforms.inputs();
        inputs.insert(
            inputs.end(),
            {{"phi", &phi.texture()}, {"velocity", &star.texture()}, {"obstacles", &voxels.texture()}});
        std::vector<Uniform> values = uniforms.uniforms();
        values.insert(values.end(), {{"pivot", pivot}, {"body", body}, {"diffusion", diffusion}});
        force_.draw(inputs, values, {&force.texture(), &moment.texture()});
        sum(force, 2 * body);
        sum(moment, 2 * body + 1);
    }
}

}  // namespace eddy::gles
