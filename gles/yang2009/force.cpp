#include "gles/yang2009/force.h"

namespace eddy::gles {

VoxelForce::VoxelForce(Gpu& gpu, const glm::ivec3& cells, double cell_m, const std::vector<BodySetup>& bodies,
                       int target_width)
    : gpu_(&gpu),
      cell_m_(cell_m),
      force_(gpu, "force", "gles/yang2009/force.frag", Cells::layout(cells),
             {.declarations = shape_declarations(bodies)}),
      sum_(gpu, "sum force", cells, target_width) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (bodies[i].force || bodies[i].torque) measured_.push_back(static_cast<int>(i));
}

void VoxelForce::draw(const Field<Cells>& phi, const Voxels& voxels, const BodyUniforms& uniforms,
                      const std::vector<BodyState>& states, const Texture& target) {
    for (int body : measured_) {
        const Field<Cells> force(*gpu_, phi.cells(), Format::RGBA32F),
            moment(*gpu_, phi.cells(), Format::RGBA32F);
        const glm::vec3 pivot(states[static_cast<std::size_t>(body)].centre_m / cell_m_);
        force_.draw({{"phi", &phi.texture()}, {"obstacles", &voxels.texture()}},
                    {uniforms.centre(), uniforms.size(), {"pivot", pivot}, {"body", body}},
                    {&force.texture(), &moment.texture()});
        sum_.draw(force.texture(), target, 2 * body);
        sum_.draw(moment.texture(), target, 2 * body + 1);
    }
}

}  // namespace eddy::gles
