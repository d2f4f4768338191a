#include "gles/fluid/pressure_level.h"

#include <algorithm>

namespace eddy::gles {
namespace {

Variant variant_of(const FluidSetup& setup) {
    return {.layouts = {{"PHI", Cells4::layout(setup.cells)}}, .defines = {{"CELLS", glsl(setup.cells)}}};
}

}  // namespace

bool PressureLevel::needed(const FluidSetup& setup) {
    return !setup.bodies.empty() &&
           std::none_of(setup.walls.begin(), setup.walls.end(),
                        [](const WallSetup& wall) { return wall.kind == WallKind::Open; });
}

PressureLevel::PressureLevel(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      sum_(gpu, "pressure level", "gles/fluid/pressure_level.frag", Cells4::layout(setup.cells).size,
           variant_of(setup)),
      subtract_(gpu, "put pressure right", "gles/fluid/put_pressure_right.frag", Cells4::layout(setup.cells),
                variant_of(setup)) {}

Field<Cells4> PressureLevel::put_right(const Field<Cells4>& phi, float most_phi) {
    const TexturePool::Lease sum = gpu_->textures().lease({1, 1}, Format::RGBA32F);
    sum_.draw({{"phi", &phi.texture()}}, {{"most_phi", most_phi}}, *sum);
    Field<Cells4> right(*gpu_, phi.cells(), Format::RGBA32F);
    subtract_.draw({{"phi", &phi.texture()}, {"sum", &*sum}}, {{"most_phi", most_phi}}, {&right.texture()});
    return right;
}

}  // namespace eddy::gles
