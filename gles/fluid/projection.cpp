#include "gles/fluid/projection.h"

#include <stdexcept>

namespace eddy::gles {
namespace {

Variant variant(const FluidSetup& setup, const Walls& walls, bool cut) {
    Variant v{.layouts = {{"FACES", Faces::layout(setup.cells)},
                          {"PHI", Cells4::layout(setup.cells)},
                          {"FRACTION", Faces4::layout(setup.cells)}},
              .defines = {{"CELLS", glsl(setup.cells)}}};
    walls.declare(v);
    if (cut) {
        v.defines.emplace_back("CUT", "");
        v.declarations += shape_declarations(setup.bodies);
    }
    return v;
}

bool predicts(const FluidSetup& setup) {
    return setup.viscosity_pa_s > 0.0;
}

Variant project_variant(const FluidSetup& setup, const Walls& walls, bool cut) {
    Variant v = variant(setup, walls, cut);
    if (predicts(setup)) v.defines.emplace_back("PREDICTS", "");
    return v;
}

Variant at_walls(Variant v) {
    v.defines.emplace_back("WALLS", "");
    return v;
}

/// The three layers of face texels at the upper walls.
Region upper_walls(const glm::ivec3& n) {
    return Region(
        {{{n.x, 0, 0}, n + 1}, {{0, n.y, 0}, {n.x, n.y + 1, n.z + 1}}, {{0, 0, n.z}, {n.x, n.y, n.z + 1}}});
}

/// Boxes of cells, and the faces on the far side of those that end at an upper wall.
std::vector<Box> with_upper_walls(std::vector<Box> boxes, const glm::ivec3& n) {
    for (Box& box : boxes) box.hi += glm::ivec3(glm::equal(box.hi, n));
    return boxes;
}

constexpr const char* kDivergence = "gles/fluid/divergence.frag";
constexpr const char* kProject = "gles/fluid/project.frag";

}  // namespace

Projection::Projection(Gpu& gpu, const FluidSetup& setup, const Walls& walls, const Fractions* fractions,
                       const BodyUniforms& bodies)
    : gpu_(&gpu),
      fractions_(fractions),
      bodies_(&bodies),
      predicts_(predicts(setup)),
      divergence_(gpu, "divergence", kDivergence, Cells4::layout(setup.cells), variant(setup, walls, false)),
      project_(gpu, "project", kProject, Faces::layout(setup.cells), project_variant(setup, walls, false)) {
    if (walls.let_through())
        project_at_walls_.emplace(gpu, "project at walls", kProject, Faces::layout(setup.cells),
                                  at_walls(project_variant(setup, walls, fractions != nullptr)));
    if (!fractions) return;
    divergence_cut_.emplace(gpu, "divergence cut", kDivergence, Cells4::layout(setup.cells),
                            variant(setup, walls, true));
    project_cut_.emplace(gpu, "project cut", kProject, Faces::layout(setup.cells),
                         project_variant(setup, walls, true));
}

void Projection::add_solids(std::vector<Input>& inputs, std::vector<Uniform>& uniforms) const {
    const std::vector<Input> a = fractions_->level(0).inputs();
    inputs.insert(inputs.end(), a.begin(), a.end());
    inputs.insert(inputs.end(), bodies_->inputs().begin(), bodies_->inputs().end());
    const std::vector<Uniform> of_bodies = bodies_->uniforms();
    uniforms.insert(uniforms.end(), of_bodies.begin(), of_bodies.end());
}

Field<Cells4> Projection::divergence(const Field<Faces>& u, double through_gaps_m_s,
                                     const std::vector<Box>& boxes, const Uniform& wall_time) {
    Field<Cells4> b(*gpu_, u.cells(), Format::RGBA32F);
    std::vector<Input> inputs{{"velocity", &u.texture()}};
    std::vector<Uniform> uniforms{wall_time};
    divergence_.draw(inputs, uniforms, {&b.texture()});
    if (fractions_) {
        add_solids(inputs, uniforms);
        uniforms.push_back({"through_gaps", static_cast<float>(through_gaps_m_s)});
        divergence_cut_->draw(inputs, uniforms, {&b.texture()}, Region::packed(boxes));
    }
    return b;
}

Field<Faces> Projection::project(const Field<Faces>& u, const Field<Cells4>& phi, float scale,
                                 const Limits& limits, const std::vector<Box>& boxes,
                                 const Uniform& wall_time) {
    if (!predicts_ && scale != 1.0f) throw std::logic_error("the pressure of another step without viscosity");
    Field<Faces> next(*gpu_, u.cells(), Format::RGBA32F);
    std::vector<Input> inputs{{"velocity", &u.texture()}, {"phi", &phi.texture()}};
    std::vector<Uniform> uniforms{{"scale", scale}, {"most_phi", limits.most_phi}, wall_time};
    project_.draw(inputs, uniforms, {&next.texture()});
    if (fractions_) {
        add_solids(inputs, uniforms);
        uniforms.push_back({"through_gaps", static_cast<float>(limits.through_gaps_m_s)});
        project_cut_->draw(inputs, uniforms, {&next.texture()}, Region(with_upper_walls(boxes, u.cells())));
    }
    if (project_at_walls_)
        project_at_walls_->draw(inputs, uniforms, {&next.texture()}, upper_walls(u.cells()));
    return next;
}

}  // namespace eddy::gles
