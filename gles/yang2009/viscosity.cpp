#include "gles/yang2009/viscosity.h"

namespace eddy::gles {

namespace {

Variant sweep_variant(const Voxels* voxels, const Walls& walls) {
    Variant variant = obstacle_variant(voxels);
    walls.declare(variant);
    return variant;
}

}  // namespace

Viscosity::Viscosity(Gpu& gpu, const FluidSetup& setup, const Voxels* voxels)
    : gpu_(&gpu),
      voxels_(voxels),
      walls_(setup),
      sweep_(gpu, "viscosity", "gles/yang2009/viscosity.frag", Cells::layout(setup.cells),
             sweep_variant(voxels, walls_)) {}

Field<Cells> Viscosity::solve(const Field<Cells>& star, float diffusion, double time_s) {
    std::vector<Input> inputs{{"star", &star.texture()}, {"velocity", &star.texture()}};
    if (voxels_) inputs.push_back({"obstacles", &voxels_->texture()});
    Field<Cells> u;
    for (int i = 0; i < kSweeps; ++i) {
        Field<Cells> next(*gpu_, star.cells(), Format::RGBA32F);
        sweep_.draw(inputs, {{"diffusion", diffusion}, walls_.time(time_s)}, {&next.texture()});
        u = std::move(next);
        inputs[1].texture = &u.texture();
    }
    return u;
}

}  // namespace eddy::gles
