#include "gles/fluid/pressure_level.h"

#include <algorithm>

namespace eddy::gles {
namespace {

Variant variant_of(const FluidSetup& setup) {
    Variant variant{
        .layouts = {{"PHI", Cells4::layout(setup.cells)}, {"FRACTION", Faces4::layout(setup.cells)}},
        .defines = {{"CELLS", glsl(setup.cells)}}};
    if (std::none_of(setup.walls.begin(), setup.walls.end(),
                     [](const WallSetup& wall) { return wall.kind == WallKind::Open; }))
        variant.defines.emplace_back("CLOSED", "");
    return variant;
}

}  // namespace

PressureLevel::PressureLevel(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      sums_(gpu, "pressure level", "gles/fluid/pressure_level.frag", Cells4::layout(setup.cells).size,
            variant_of(setup)),
      put_right_(gpu, "put pressure right", "gles/fluid/put_pressure_right.frag", Cells4::layout(setup.cells),
                 variant_of(setup)) {}

Field<Cells4> PressureLevel::put_right(const Field<Cells4>& phi, const FaceFractions& a, float most_phi) {
    const TexturePool::Lease sums = gpu_->textures().lease({1, 1}, Format::RGBA32F);
    std::vector<Input> inputs = a.inputs();
    inputs.push_back({"phi", &phi.texture()});
    sums_.draw(inputs, {{"most_phi", most_phi}}, *sums);
    Field<Cells4> right(*gpu_, phi.cells(), Format::RGBA32F);
    put_right_.draw({{"phi", &phi.texture()}, {"sum", &*sums}}, {{"most_phi", most_phi}}, {&right.texture()});
    return right;
}

}  // namespace eddy::gles
