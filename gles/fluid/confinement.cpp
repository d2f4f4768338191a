#include "gles/fluid/confinement.h"

namespace eddy::gles {

Confinement::Confinement(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      strength_1_s_(static_cast<float>(setup.confinement_1_s)),
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
    force_.draw({{"vorticity", &vorticity.texture()}, {"velocity", &u.texture()}},
                {{"strength", strength_1_s_}, {"driven", static_cast<float>(driven_m_s)}},
                {&force.texture()});
    Field<Faces> next(*gpu_, u.cells(), Format::RGBA32F);
    confine_.draw({{"velocity", &u.texture()}, {"force", &force.texture()}},
                  {{"dt", static_cast<float>(dt_s)}}, {&next.texture()});
    return next;
}

}  // namespace eddy::gles
