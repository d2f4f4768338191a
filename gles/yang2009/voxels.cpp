#include "gles/yang2009/voxels.h"

namespace eddy::gles {

Voxels::Voxels(Gpu& gpu, const glm::ivec3& cells, const std::vector<BodySetup>& bodies)
    : io_(gpu, cells, Format::RGBA32F),
      voxelise_(gpu, "voxelise", "gles/yang2009/voxelise.frag", Cells::layout(cells),
                {.declarations = shape_declarations(bodies)}) {}

void Voxels::update(const BodyUniforms& bodies) {
    voxelise_.draw(bodies.inputs(), bodies.uniforms(), {&io_.texture()});
}

Variant obstacle_variant(const Voxels* voxels) {
    return voxels ? Variant{.defines = {{"OBSTACLES", ""}}} : Variant{};
}

}  // namespace eddy::gles
