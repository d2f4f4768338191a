#include "gles/yang2009/jacobi.h"

#include "gles/grid_io.h"

namespace eddy::gles {

Jacobi::Jacobi(Gpu& gpu, const glm::ivec3& cells, const Voxels* voxels)
    : gpu_(&gpu),
      voxels_(voxels),
      zero_(gpu, cells, Format::R32F),
      sweep_(gpu, "jacobi", "gles/yang2009/jacobi.frag", Cells::layout(cells), obstacle_variant(voxels)) {
    clear(zero_.texture());
}

Field<Cells> Jacobi::solve(const Field<Cells>& d, int sweeps) {
    std::vector<Input> inputs{{"phi", &zero_.texture()}, {"d", &d.texture()}};
    if (voxels_) inputs.push_back({"obstacles", &voxels_->texture()});
    Field<Cells> phi;
    for (int i = 0; i < sweeps; ++i) {
        Field<Cells> next(*gpu_, d.cells(), Format::R32F);
        sweep_.draw(inputs, {}, {&next.texture()});
        phi = std::move(next);
        inputs[0].texture = &phi.texture();
    }
    return phi;
}

}  // namespace eddy::gles
