#include "gles/fluid/transport_energy.h"

#include <algorithm>

namespace eddy::gles {
namespace {

Variant variant_of(const FluidSetup& setup) {
    return {.layouts = {{"FACES", Faces::layout(setup.cells)}}, .defines = {{"CELLS", glsl(setup.cells)}}};
}

}  // namespace

bool TransportEnergy::needed(const FluidSetup& setup) {
    const bool makes = setup.solver.advection == Advection::MacCormack || setup.solver.time_order == 2;
    const WallSetup still;
    // Where friction is so strong that it never acts, not even in the shortest step, there is nothing to draw.
    const bool may_act = acts(diffusion_number(setup, setup.shortest_step_s));
    return makes && may_act &&
           std::all_of(setup.walls.begin(), setup.walls.end(), [&](const WallSetup& wall) {
               return wall.kind != WallKind::Inflow && wall.velocity_m_s.glsl == still.velocity_m_s.glsl;
           });
}

TransportEnergy::TransportEnergy(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      sum_(gpu, "transport energy", "gles/fluid/transport_energy.frag", Faces::layout(setup.cells).size,
           variant_of(setup)),
      scale_(gpu, "keep energy", "gles/fluid/keep_energy.frag", Faces::layout(setup.cells)) {}

Field<Faces> TransportEnergy::keep(Field<Faces> u_star, const Field<Faces>& before) {
    const TexturePool::Lease energy = gpu_->textures().lease({1, 1}, Format::RGBA32F);
    // guard transport_energy
    sum_.draw({{"before", &before.texture()}, {"after", &u_star.texture()}}, {}, *energy);
    Field<Faces> kept(*gpu_, u_star.cells(), Format::RGBA32F);
    scale_.draw({{"velocity", &u_star.texture()}, {"energy", &*energy}}, {}, {&kept.texture()});
    return kept;
}

}  // namespace eddy::gles
