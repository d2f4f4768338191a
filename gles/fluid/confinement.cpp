#include "gles/fluid/confinement.h"

#include <algorithm>

namespace eddy::gles {
namespace {

/// Of eps dt: in a step an eddy is pushed by no more than a quarter of what neighbouring cells differ by. Stronger, the push turns
/// the eddy's cells against each other before the transport sees them.
constexpr double kMostOfAStep = 0.25;

}  // namespace

Confinement::Confinement(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      strength_1_s_(setup.confinement_1_s),
      vorticity_(gpu, "vorticity", "gles/fluid/vorticity.frag", Cells::layout(setup.cells),
                 Variant{.layouts = {{"FACES", Faces::layout(setup.cells)}},
                         .defines = {{"CELLS", glsl(setup.cells)}}}),
      force_(gpu, "confinement", "gles/fluid/confinement.frag", Cells::layout(setup.cells),
             Variant{.layouts = {{"FACES", Faces::layout(setup.cells)}}}),
      confine_(gpu, "confine", "gles/fluid/confine.frag", Faces::layout(setup.cells),
               Variant{.layouts = {{"CELL_CENTRES", Cells::layout(setup.cells)}}}) {}

Field<Faces> Confinement::add_to(const Field<Faces>& u, double driven_m_s, double dt_s) {
    const Field<Cells> vorticity(*gpu_, u.cells(), Format::RGBA32F);
    const Field<Cells> force(*gpu_, u.cells(), Format::RGBA32F);
    vorticity_.draw({{"velocity", &u.texture()}}, {}, {&vorticity.texture()});
    const double strength_1_s = std::min(strength_1_s_, kMostOfAStep / dt_s);  // guard confinement_step
    force_.draw({{"vorticity", &vorticity.texture()}, {"velocity", &u.texture()}},
                {{"strength", static_cast<float>(strength_1_s)}, {"driven", static_cast<float>(driven_m_s)}},
                {&force.texture()});
    Field<Faces> next(*gpu_, u.cells(), Format::RGBA32F);
    confine_.draw({{"velocity", &u.texture()}, {"force", &force.texture()}},
                  {{"dt", static_cast<float>(dt_s)}}, {&next.texture()});
    return next;
}

}  // namespace eddy::gles
