#include "gles/body/traction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy::gles {

Traction::Traction(Gpu& gpu, const glm::ivec3& cells, double cell_m, const std::vector<BodySetup>& bodies,
                   int target_width)
    : gpu_(&gpu), cell_m_(cell_m) {
    const Variant variant{.layouts = {{"PHI", Cells4::layout(cells)}, {"FRACTION", Faces4::layout(cells)}},
                          .defines = {{"CELLS", glsl(cells)}},
                          .declarations = shape_declarations(bodies)};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!bodies[i].force && !bodies[i].torque) continue;
        // The widest box the body can have, whatever its position within a cell (see body_box).
        const int reach =
            static_cast<int>(std::ceil(2.0 * (bounding_radius_m(bodies[i].shape) / cell_m + 2.0))) + 1;
        const glm::ivec2 columns(std::min(reach, cells.x), std::min(reach, cells.y));
        const AtlasLayout layout{{columns.x, columns.y, 1}, 1};
        bodies_.push_back(
            {static_cast<int>(i), columns,
             Pass(gpu, fmt::format("traction {}", i), "gles/body/traction.frag", layout, variant),
             Reduce(gpu, fmt::format("sum traction {}", i), columns, {target_width, 1})});
    }
}

void Traction::draw(const Field<Cells4>& phi, const FaceFractions& a, const BodyUniforms& uniforms,
                    const std::vector<BodyState>& states, const std::vector<Box>& boxes,
                    const Texture& target) {
    for (Body& body : bodies_) {
        const TexturePool::Lease force = gpu_->textures().lease(body.columns, Format::RGBA32F);
        const TexturePool::Lease moment = gpu_->textures().lease(body.columns, Format::RGBA32F);
        const auto index = static_cast<std::size_t>(body.index);
        const Box& box = boxes[index];
        body.sum_columns.draw(
            {{"phi", &phi.texture()}, {"ax", &a.x.texture()}, {"ay", &a.y.texture()}, {"az", &a.z.texture()}},
            {uniforms.centre(),
             uniforms.size(),
             {"box_low", glm::ivec3(box.lo.x, box.lo.y, box.lo.z / 4)},
             {"box_high", glm::ivec3(box.hi.x, box.hi.y, (box.hi.z + 3) / 4)},
             {"pivot", glm::vec3(states[index].centre_m / cell_m_)},
             {"body", body.index}},
            {&*force, &*moment});
        body.reduce.draw(*force, target, {2 * body.index, 0});
        body.reduce.draw(*moment, target, {2 * body.index + 1, 0});
    }
}

}  // namespace eddy::gles
