#include "gles/fluid/pressure_level.h"

#include <fmt/format.h>

#include <algorithm>

namespace eddy::gles {
namespace {

constexpr int kRun = 8;  // texels of a row that one fragment adds up

AtlasLayout rows_of(const FluidSetup& setup) {
    const glm::ivec3 slabs = Cells4::layout(setup.cells).size;
    return AtlasLayout::tile({(slabs.x + kRun - 1) / kRun, slabs.y, slabs.z});
}

Variant variant_of(const FluidSetup& setup) {
    return {.layouts = {{"PHI", Cells4::layout(setup.cells)}},
            .defines = {{"RUN", fmt::format("{}", kRun)}, {"CELLS", glsl(setup.cells)}}};
}

}  // namespace

bool PressureLevel::needed(const FluidSetup& setup) {
    return !setup.bodies.empty() &&
           std::none_of(setup.walls.begin(), setup.walls.end(),
                        [](const WallSetup& wall) { return wall.kind == WallKind::Open; });
}

PressureLevel::PressureLevel(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      rows_(rows_of(setup)),
      add_up_(gpu, "pressure level", "gles/fluid/pressure_level.frag", rows_, variant_of(setup)),
      sum_(gpu, "reduce pressure level", rows_.texels(), {1, 1}),
      subtract_(gpu, "put pressure right", "gles/fluid/put_pressure_right.frag", Cells4::layout(setup.cells),
                variant_of(setup)) {}

Field<Cells4> PressureLevel::put_right(const Field<Cells4>& phi, float most_phi) {
    const TexturePool::Lease rows = gpu_->textures().lease(rows_.texels(), Format::RGBA32F);
    const TexturePool::Lease sum = gpu_->textures().lease({1, 1}, Format::RGBA32F);
    add_up_.draw({{"phi", &phi.texture()}}, {{"most_phi", most_phi}}, {&*rows});
    sum_.draw(*rows, *sum, {0, 0});
    Field<Cells4> right(*gpu_, phi.cells(), Format::RGBA32F);
    subtract_.draw({{"phi", &phi.texture()}, {"sum", &*sum}}, {}, {&right.texture()});
    return right;
}

}  // namespace eddy::gles
