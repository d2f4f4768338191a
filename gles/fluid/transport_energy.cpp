#include "gles/fluid/transport_energy.h"

#include <fmt/format.h>

#include <algorithm>

namespace eddy::gles {
namespace {

constexpr int kRun = 8;  // texels of a row that one fragment adds up

Variant variant_of(const FluidSetup& setup) {
    return {.layouts = {{"FACES", Faces::layout(setup.cells)}},
            .defines = {{"RUN", fmt::format("{}", kRun)}, {"CELLS", glsl(setup.cells)}}};
}

AtlasLayout rows_of(const FluidSetup& setup) {
    const glm::ivec3 faces = Faces::layout(setup.cells).size;
    return AtlasLayout::tile({(faces.x + kRun - 1) / kRun, faces.y, faces.z});
}

}  // namespace

bool TransportEnergy::needed(const FluidSetup& setup) {
    const bool makes = setup.solver.advection == Advection::MacCormack || setup.solver.time_order == 2;
    const WallSetup still;
    return makes && std::all_of(setup.walls.begin(), setup.walls.end(), [&](const WallSetup& wall) {
               const bool closed = wall.kind == WallKind::Slip || wall.kind == WallKind::NoSlip;
               return closed && wall.velocity_m_s.glsl == still.velocity_m_s.glsl;
           });
}

TransportEnergy::TransportEnergy(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      rows_(rows_of(setup)),
      add_up_(gpu, "transport energy", "gles/fluid/transport_energy.frag", rows_, variant_of(setup)),
      sum_(gpu, "reduce transport energy", rows_.texels(), {1, 1}),
      scale_(gpu, "keep energy", "gles/fluid/keep_energy.frag", Faces::layout(setup.cells)) {}

Field<Faces> TransportEnergy::keep(Field<Faces> u_star, const Field<Faces>& before) {
    const TexturePool::Lease rows = gpu_->textures().lease(rows_.texels(), Format::RGBA32F);
    const TexturePool::Lease energy = gpu_->textures().lease({1, 1}, Format::RGBA32F);
    // guard transport_energy
    add_up_.draw({{"before", &before.texture()}, {"after", &u_star.texture()}}, {}, {&*rows});
    sum_.draw(*rows, *energy, {0, 0});
    Field<Faces> kept(*gpu_, u_star.cells(), Format::RGBA32F);
    scale_.draw({{"velocity", &u_star.texture()}, {"energy", &*energy}}, {}, {&kept.texture()});
    return kept;
}

}  // namespace eddy::gles
