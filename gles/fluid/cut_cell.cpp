#include "gles/fluid/cut_cell.h"

#include <algorithm>

#include <fmt/format.h>

#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// More V-cycles for the first step, which has no pressure of the last one to start from: its force is an
/// impulse, and comes out right (2 cycles alone: 2 % low; 5: within 0.02 % of the converged one).
constexpr int kColdCycles = 3;

/// What the passes between faces and cells are compiled with.
Variant grid_variant(const FluidSetup& setup, bool cut, bool walls = false) {
    Variant v{.layouts = {{"FACES", Faces::layout(setup.cells)},
                          {"PHI", Cells4::layout(setup.cells)},
                          {"FRACTION", Faces4::layout(setup.cells)}},
              .defines = {{"CELLS", glsl(setup.cells)}}};
    if (cut) {
        v.defines.emplace_back("CUT", "");
        v.declarations = shape_declarations(setup.bodies);
    }
    if (walls) v.defines.emplace_back("WALLS", "");
    return v;
}

/// The three layers of face texels at the upper walls.
Region upper_walls(const glm::ivec3& n) {
    return Region(
        {{{n.x, 0, 0}, n + 1}, {{0, n.y, 0}, {n.x, n.y + 1, n.z + 1}}, {{0, 0, n.z}, {n.x, n.y, n.z + 1}}});
}

}  // namespace

CutCellFluid::CutCellFluid(Gpu& gpu, FluidSetup setup)
    : Fluid(std::move(setup)),
      gpu_(gpu),
      u_(gpu, setup_.cells, Format::RGBA32F),
      phi_(gpu, setup_.cells, Format::RGBA32F),
      advect_(gpu, setup_.cells, setup_.cell_m, setup_.solver.advection),
      fractions_(
          setup_.bodies.empty()
              ? std::optional<Fractions>()
              : std::optional<Fractions>(std::in_place, gpu, multigrid_levels(setup_.cells), setup_.bodies)),
      body_uniforms_(setup_.bodies, setup_.cell_m),
      divergence_(gpu, "divergence", "gles/fluid/divergence.frag", Cells4::layout(setup_.cells),
                  grid_variant(setup_, false)),
      pressure_(gpu, setup_.cells, fractions_ ? &*fractions_ : nullptr),
      project_(gpu, "project", "gles/fluid/project.frag", Faces::layout(setup_.cells),
               grid_variant(setup_, false)),
      project_walls_(gpu, "project at walls", "gles/fluid/project.frag", Faces::layout(setup_.cells),
                     grid_variant(setup_, fractions_.has_value(), true)),
      results_(gpu, setup_) {
    if (fractions_) {
        divergence_cut_.emplace(gpu, "divergence cut", "gles/fluid/divergence.frag",
                                Cells4::layout(setup_.cells), grid_variant(setup_, true));
        project_cut_.emplace(gpu, "project cut", "gles/fluid/project.frag", Faces::layout(setup_.cells),
                             grid_variant(setup_, true));
    }
    if (Results::measures(setup_))
        traction_.emplace(gpu, setup_.cells, setup_.cell_m, setup_.bodies, Results::width(setup_));
    if (setup_.smoke) advect_smoke_.emplace(gpu, setup_);
    for (const SourceSetup& source : setup_.sources)
        if (source.velocity_m_s && !drive_)
            drive_.emplace(gpu, "drive sources", "gles/fluid/drive.frag", Faces::layout(setup_.cells),
                           Variant{});
    reset();
}

void CutCellFluid::reset() {
    const glm::ivec3 n = setup_.cells;
    const auto faces = static_cast<std::size_t>((n.x + 1) * (n.y + 1) * (n.z + 1));
    set_velocity(std::vector<glm::vec3>(faces, glm::vec3(setup_.velocity_m_s)));
    clear(phi_.texture());
    if (setup_.smoke) {
        smoke_ = Field<Cells>(gpu_, n, Format::R32F);
        clear(smoke_->texture());
    }
    results_.forget();
    before_.clear();
    step_ = 0;
    time_s_ = 0.0;
}

void CutCellFluid::step(double dt_s, const std::vector<BodyState>& bodies, bool wants_diagnosis) {
    const float guess_scale = dt_s_ > 0.0 ? static_cast<float>(dt_s / dt_s_) : 1.0f;  // phi ~ dt p
    dt_s_ = dt_s;
    body_uniforms_.set(bodies);
    boxes_.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        boxes_.push_back(body_box(setup_.bodies[i].shape, bodies[i], setup_.cell_m, setup_.cells));

    std::vector<Box> rough = boxes_;
    for (const SourceSetup& source : setup_.sources)
        if (source.velocity_m_s && is_running(source, time_s_))
            rough.push_back(ball_box(ball_cells(source, setup_.cell_m), setup_.cells));

    Field<Faces> u;
    {
        Gpu::Stage stage(gpu_, "advect velocity");
        u = drive_sources(advect_(u_, dt_s));  // u* = u(x - dt u)
    }
    if (smoke_) {
        Gpu::Stage stage(gpu_, "advect smoke");
        smoke_ = (*advect_smoke_)(*smoke_, u_, time_s_, dt_s);  // s = s(x - dt u) + dt q
    }
    if (fractions_) {
        Gpu::Stage stage(gpu_, "voxelise");
        fractions_->update(body_uniforms_, boxes_);  // a, where the bodies are now
    }
    Field<Cells4> b;
    {
        Gpu::Stage stage(gpu_, "divergence");
        b = divergence(u);  // b = div (a u* + (1 - a) u_solid)
    }
    {
        Gpu::Stage stage(gpu_, "pressure");
        phi_ = pressure_.follow(std::move(phi_), motions(bodies));
        phi_ = pressure_.solve(std::move(phi_), b,
                               {.cycles = setup_.solver.cycles + (step_ == 0 ? kColdCycles : 0),
                                .guess_scale = guess_scale,
                                .cut = boxes_,
                                .rough = rough});  // div (a grad phi) = b
    }
    {
        Gpu::Stage stage(gpu_, "project");
        u_ = std::move(u);
        u_ = subtract_gradient(u_);  // u = u* - grad phi
    }
    before_ = bodies;
    ++step_;
    time_s_ += dt_s;
    if (traction_) {
        Gpu::Stage stage(gpu_, "force");
        traction_->draw(phi_, fractions_->level(0), body_uniforms_, bodies, boxes_,
                        results_.row());  // F = int p grad(1 - a)
    }
    if (wants_diagnosis) {
        Gpu::Stage stage(gpu_, "diagnose");
        diagnose(b);
    }
    if (traction_ || wants_diagnosis) {
        Gpu::Stage stage(gpu_, "read back");
        results_.request(step_, dt_s, wants_diagnosis);
    }
}

std::vector<BodyMotion> CutCellFluid::motions(const std::vector<BodyState>& bodies) const {
    std::vector<BodyMotion> result;
    for (std::size_t i = 0; i < before_.size(); ++i)
        result.push_back({glm::vec3(bodies[i].centre_m / setup_.cell_m),
                          glm::vec3((bodies[i].centre_m - before_[i].centre_m) / setup_.cell_m),
                          static_cast<float>(bounding_radius_m(setup_.bodies[i].shape) / setup_.cell_m)});
    return result;
}

Field<Faces> CutCellFluid::drive_sources(Field<Faces> u) {
    for (const SourceSetup& source : setup_.sources) {
        if (!source.velocity_m_s || !is_running(source, time_s_)) continue;
        const glm::vec4 ball = ball_cells(source, setup_.cell_m);
        drive_->draw({}, {{"ball", ball}, {"ball_velocity", glm::vec3(*source.velocity_m_s)}}, {&u.texture()},
                     Region({ball_box(ball, setup_.cells)}));
    }
    return u;
}

Field<Cells4> CutCellFluid::divergence(const Field<Faces>& u) {
    Field<Cells4> b(gpu_, setup_.cells, Format::RGBA32F);
    divergence_.draw({{"velocity", &u.texture()}}, {}, {&b.texture()});
    if (fractions_) {
        const FaceFractions& a = fractions_->level(0);
        divergence_cut_->draw({{"velocity", &u.texture()},
                               {"ax", &a.x.texture()},
                               {"ay", &a.y.texture()},
                               {"az", &a.z.texture()}},
                              {body_uniforms_.centre(), body_uniforms_.size(), body_uniforms_.velocity(),
                               body_uniforms_.spin()},
                              {&b.texture()}, Region::packed(boxes_));
    }
    return b;
}

Field<Faces> CutCellFluid::subtract_gradient(const Field<Faces>& u) {
    Field<Faces> next(gpu_, setup_.cells, Format::RGBA32F);
    std::vector<Input> inputs{{"velocity", &u.texture()}, {"phi", &phi_.texture()}};
    std::vector<Uniform> uniforms;
    project_.draw(inputs, {}, {&next.texture()});
    if (fractions_) {
        const FaceFractions& a = fractions_->level(0);
        inputs.insert(inputs.end(), {{"ax", &a.x.texture()}, {"ay", &a.y.texture()}, {"az", &a.z.texture()}});
        uniforms = {body_uniforms_.centre(), body_uniforms_.size(), body_uniforms_.velocity(),
                    body_uniforms_.spin()};
        project_cut_->draw(inputs, uniforms, {&next.texture()}, Region(boxes_));
    }
    project_walls_.draw(inputs, uniforms, {&next.texture()}, upper_walls(setup_.cells));
    return next;
}

void CutCellFluid::diagnose(const Field<Cells4>& before) {
    if (!diagnose_) {
        Variant variant = grid_variant(setup_, false);
        if (smoke_) {
            variant.layouts.emplace_back("SMOKE_CELLS", Cells::layout(setup_.cells));
            variant.defines.emplace_back("SMOKE", "");
        }
        const glm::ivec2 columns(setup_.cells.x, setup_.cells.y);
        diagnose_.emplace(gpu_, "diagnose", "gles/fluid/diagnose.frag",
                          AtlasLayout{{columns.x, columns.y, 1}, 1}, variant);
        reduce_diagnosis_.emplace(gpu_, "reduce diagnosis", columns, glm::ivec2(Results::width(setup_), 1),
                                  "vec4(1.0, 0.0, 0.0, 1.0)");
    }
    const Field<Cells4> after = divergence(u_);
    const TexturePool::Lease columns =
        gpu_.textures().lease({setup_.cells.x, setup_.cells.y}, Format::RGBA32F);
    std::vector<Input> inputs{
        {"velocity", &u_.texture()}, {"divergence", &after.texture()}, {"before", &before.texture()}};
    if (smoke_) inputs.push_back({"smoke", &smoke_->texture()});
    diagnose_->draw(inputs, {}, {&*columns});
    reduce_diagnosis_->draw(*columns, results_.row(), Results::diagnosis_texel(setup_));
}

std::vector<glm::vec3> CutCellFluid::velocity() const {
    return unpack_vectors(u_.texture().download(), u_.layout());
}

std::vector<float> CutCellFluid::pressure() const {
    std::vector<float> p = unpack_four(phi_.texture().download(), phi_.layout(), setup_.cells);
    const double pascal = dt_s_ > 0.0 ? setup_.density_kg_m3 * setup_.cell_m / dt_s_ : 0.0;
    for (float& value : p) value = static_cast<float>(value * pascal);
    return p;
}

void CutCellFluid::set_velocity(const std::vector<glm::vec3>& u) {
    const std::vector<glm::vec4> texels = pack_vectors(u, u_.layout());
    u_.texture().upload(&texels[0].x);
}

}  // namespace eddy::gles
