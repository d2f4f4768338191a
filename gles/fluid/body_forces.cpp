#include "gles/fluid/body_forces.h"

#include <fmt/format.h>

#include "gles/fluid/walls.h"

namespace eddy::gles {
namespace {

bool has_gravity(const FluidSetup& setup) {
    return setup.gravity_m_s2 != glm::dvec3(0.0);
}

bool has_weight(const FluidSetup& setup) {
    return has_gravity(setup) && setup.smoke && setup.smoke->weight != 0.0;
}

bool is_lifted(const FluidSetup& setup) {
    return has_gravity(setup) && setup.temperature && setup.temperature->expansion_1_k != 0.0;
}

/// The forces this scene has.
Variant force_variant(const FluidSetup& setup) {
    Variant v;
    v.layouts.emplace_back("CELL_CENTRES", Cells::layout(setup.cells));
    if (has_gravity(setup)) v.defines.emplace_back("GRAVITY", "");
    if (has_weight(setup)) v.defines.emplace_back("WEIGHT", "");
    if (is_lifted(setup)) v.defines.emplace_back("LIFT", "");
    if (setup.acceleration_m_s2) {
        const auto& f = setup.acceleration_m_s2->glsl;
        v.defines.emplace_back("FORCING", "");
        v.declarations = setup.formula_helpers + kWhereFinite +
                         fmt::format(
                             "uniform float time;  // [s]\nvec3 forcing(vec3 cells) {{\n{}    "
                             "return where_finite(vec3({}, {}, {}));\n}}\n",
                             formula_variables(setup.cell_m, "time"), f[0], f[1], f[2]);
    }
    return v;
}

}  // namespace

bool BodyForces::needed(const FluidSetup& setup) {
    return has_gravity(setup) || setup.acceleration_m_s2;
}

BodyForces::BodyForces(Gpu& gpu, const FluidSetup& setup)
    : gpu_(&gpu),
      setup_(&setup),
      add_(gpu, "body forces", "gles/fluid/body_forces.frag", Faces::layout(setup.cells),
           force_variant(setup)) {}

Field<Faces> BodyForces::add_to(const Field<Faces>& u, const Field<Cells>* smoke,
                                const Field<Cells>* temperature, double time_s, double dt_s) {
    std::vector<Input> inputs{{"velocity", &u.texture()}};
    std::vector<Uniform> uniforms{{"dt", static_cast<float>(dt_s)},
                                  {"gravity", glm::vec3(setup_->gravity_m_s2)},
                                  {"time", static_cast<float>(time_s)}};
    if (has_weight(*setup_)) {
        inputs.push_back({"smoke", &smoke->texture()});
        uniforms.push_back({"weight", static_cast<float>(setup_->smoke->weight)});
    }
    if (is_lifted(*setup_)) {
        inputs.push_back({"temperature", &temperature->texture()});
        uniforms.push_back({"expansion", static_cast<float>(setup_->temperature->expansion_1_k)});
    }
    Field<Faces> next(*gpu_, setup_->cells, Format::RGBA32F);
    add_.draw(inputs, uniforms, {&next.texture()});
    return next;
}

}  // namespace eddy::gles
