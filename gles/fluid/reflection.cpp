#include "gles/fluid/reflection.h"

#include "gles/body/rigid_body.h"
#include "gles/fluid/results.h"

namespace eddy::gles {
namespace {

AtlasLayout row_layout(const FluidSetup& setup) {
    return {{Results::width(setup), 1, 1}, 1};
}

}  // namespace

Reflection::Reflection(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      bodies_(static_cast<int>(setup.bodies.size())),
      mirror_(gpu, "reflect", "gles/fluid/reflect.frag", Faces::layout(setup.cells)),
      add_(gpu, "add halves", "gles/fluid/add_halves.frag", Cells4::layout(setup.cells)),
      add_loads_(gpu, "add loads", "gles/fluid/add_halves.frag", row_layout(setup)) {
    if (!Results::measures(setup)) return;
    first_loads_ = gpu.textures().lease({Results::width(setup), 1}, Format::RGBA32F);
    second_loads_ = gpu.textures().lease({Results::width(setup), 1}, Format::RGBA32F);
}

Field<Faces> Reflection::mirror(const Field<Faces>& u, const Field<Faces>& u_star) {
    Field<Faces> mirrored(*gpu_, u.cells(), Format::RGBA32F);
    mirror_.draw({{"velocity", &u.texture()}, {"before", &u_star.texture()}}, {}, {&mirrored.texture()});
    return mirrored;
}

Field<Cells4> Reflection::add(const Field<Cells4>& first, const Field<Cells4>& second) {
    Field<Cells4> sum(*gpu_, first.cells(), Format::RGBA32F);
    add_.draw({{"first", &first.texture()}, {"second", &second.texture()}}, {}, {&sum.texture()});
    return sum;
}

void Reflection::add_loads(const Texture& row) {
    add_loads_.draw({{"first", &*first_loads_}, {"second", &*second_loads_}}, {}, {&row},
                    Region({Box{{0, 0, 0}, {2 * bodies_, 1, 1}}}));
}

std::vector<BodyState> half_a_step_before(std::vector<BodyState> bodies, double dt_s) {
    for (BodyState& body : bodies) {
        body.centre_m -= 0.5 * dt_s * body.velocity_m_s;
        body.orientation = turned(body.orientation, body.spin_rad_s, -0.5 * dt_s);
    }
    return bodies;
}

}  // namespace eddy::gles
