#include "gles/yang2009/yang2009.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// Projections of a velocity that comes from elsewhere. The method's own flows are never free of divergence: with 1 the first
/// force after taking over is up to three times too large (40 sweeps, 32^3 cells), with 4 half of what it should be.
constexpr int kTakeOverProjections = 2;

Variant carrying(Variant variant, const FluidSetup& setup) {
    variant.defines.push_back(farthest(setup));
    return variant;
}

}  // namespace

Yang2009Fluid::Yang2009Fluid(Gpu& gpu, FluidSetup setup)
    : Fluid(std::move(setup)),
      gpu_(gpu),
      u_(gpu, setup_.cells, Format::RGBA32F),
      phi_(gpu, setup_.cells, Format::R32F),
      voxels_(setup_.bodies.empty() ? std::optional<Voxels>()
                                    : std::optional<Voxels>(std::in_place, gpu, setup_.cells, setup_.bodies)),
      body_uniforms_(gpu_, setup_.bodies, setup_.cell_m),
      advect_velocity_(gpu, "advect velocity", "gles/yang2009/advect_velocity.frag", u_.layout(),
                       carrying(obstacle_variant(voxels()), setup_)),
      divergence_(gpu, "divergence", "gles/yang2009/divergence.frag", u_.layout(),
                  obstacle_variant(voxels())),
      pressure_(gpu, setup_.cells, voxels()),
      project_(gpu, "project", "gles/yang2009/project.frag", u_.layout(), obstacle_variant(voxels())),
      health_(gpu, setup_, u_.layout(), phi_.layout()),
      results_(gpu, setup_) {
    if (Results::measures(setup_)) force_.emplace(gpu, setup_, Results::width(setup_));
    if (setup_.viscosity_pa_s > 0.0) viscosity_.emplace(gpu, setup_, voxels());
    for (const SourceSetup& source : setup_.sources) {
        if (source.velocity_m_s && !drive_)
            drive_.emplace(gpu, "drive sources", "gles/fluid/drive.frag", u_.layout());
        if (source.smoke_per_s > 0.0) {
            smoke_balls_.push_back(ball_cells(source, setup_.cell_m));
            smoke_boxes_.push_back(ball_box(smoke_balls_.back(), setup_.cells));
        }
    }
    if (setup_.smoke) {
        const char* shader = "gles/yang2009/advect_smoke.frag";
        Variant variant = carrying({}, setup_);
        if (setup_.smoke->dissipation_1_s > 0.0) variant.defines.emplace_back("FADES", "");
        advect_smoke_.emplace(gpu, "advect smoke", shader, u_.layout(), variant);
        if (!smoke_balls_.empty()) {
            variant.defines.emplace_back("SOURCES", fmt::format("{}", smoke_balls_.size()));
            smoke_sources_.emplace(gpu, "smoke sources", shader, u_.layout(), variant);
        }
    }
    start_over();
}

void Yang2009Fluid::start_over() {
    const glm::ivec3 n = setup_.cells;
    std::vector<glm::vec3> u = setup_.velocities_at_start;
    for (int z = 0; z < n.z && setup_.velocities_at_start.empty(); ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x)
                u.emplace_back(setup_.velocity_at_start
                                   ? setup_.velocity_at_start(setup_.cell_m * (glm::dvec3(x, y, z) + 0.5))
                                   : glm::dvec3(0.0));
    set_velocity(u);
    clear(phi_.texture());
    if (setup_.smoke) {
        smoke_ = Field<Cells>(gpu_, n, Format::R32F);
        clear(smoke_->texture());
    }
    results_.forget();
    bodies_.clear();
    step_ = 0;
    time_s_ = 0.0;
}

FluidState Yang2009Fluid::state() const {
    return {.setup = setup_,
            .bodies = bodies_,
            .steps = step_,
            .time_s = time_s_,
            .dt_s = dt_s_,
            .at_centres = &u_,
            .phi = &phi_,
            .smoke = smoke()};
}

void Yang2009Fluid::resume(const FluidState& from) {
    Gpu::Stage stage(gpu_, "take over");
    if (!resample_) resample_.emplace(gpu_, setup_.cells);
    const bool same_grid = from.at_centres && from.setup.cells == setup_.cells;
    results_.forget();
    step_ = from.steps;
    time_s_ = from.time_s;
    dt_s_ = from.dt_s;
    u_ = from.on_faces ? resample_->at_centres(*from.on_faces) : resample_->at_centres(*from.at_centres);
    if (!same_grid && step_ > 0) free_of_divergence();
    // dt p is the same; it is counted in rho h.
    const auto gain = static_cast<float>(from.setup.density_kg_m3 * from.setup.cell_m /
                                         (setup_.density_kg_m3 * setup_.cell_m));
    phi_ = from.phi4 ? resample_->in_cells(*from.phi4, gain) : resample_->in_cells(*from.phi, gain);
    if (smoke_ && from.smoke)
        smoke_ = resample_->in_cells(*from.smoke);
    else if (smoke_)
        clear(smoke_->texture());
}

void Yang2009Fluid::free_of_divergence() {
    body_uniforms_.set(bodies_);
    if (voxels_) voxels_->update(body_uniforms_);
    for (int i = 0; i < kTakeOverProjections; ++i) {
        phi_ = pressure_.solve(divergence(u_), setup_.solver.jacobi_sweeps);
        u_ = subtract_gradient(u_);
    }
}

void Yang2009Fluid::move_on(double dt_s, const std::vector<BodyState>& bodies, bool wants_diagnosis) {
    health_.draw({.velocity = &u_.texture(), .phi = &phi_.texture(), .smoke = smoke()}, sound(setup_, dt_s),
                 results_.row());
    dt_s_ = dt_s;
    bodies_ = bodies;
    body_uniforms_.set(bodies);
    if (voxels_) {
        Gpu::Stage stage(gpu_, "voxelise");
        voxels_->update(body_uniforms_);  // T_IO, where the bodies are now
    }
    Field<Cells> u;
    {
        Gpu::Stage stage(gpu_, "advect velocity");
        u = advect_velocity();  // u* = u(x - dt u);  u* = u_obstacle in obstacles
    }
    const float diffusion = diffusion_number(setup_, dt_s);
    if (viscosity_) {
        Gpu::Stage stage(gpu_, "viscosity");
        u = viscosity_->solve(u, diffusion, time_s_ + dt_s);  // (1 - nu dt laplacian) u = u*
    }
    if (drive_) {
        Gpu::Stage stage(gpu_, "drive sources");
        u = drive_sources(std::move(u));  // u* = u_source in the balls of the sources
    }
    if (smoke_) {
        Gpu::Stage stage(gpu_, "advect smoke");
        smoke_ = advect_smoke();  // s = s(x - dt u) + dt q
    }
    Field<Cells> d;
    {
        Gpu::Stage stage(gpu_, "divergence");
        d = divergence(u);  // d = 1/2 sum (u*_{+} - u*_{-})
    }
    {
        Gpu::Stage stage(gpu_, "pressure");
        phi_ = pressure_.solve(d, setup_.solver.jacobi_sweeps);  // sum (phi_nb - phi) = d
    }
    {
        Gpu::Stage stage(gpu_, "project");
        u_ = subtract_gradient(u);  // u = u* - 1/2 (phi_{+} - phi_{-})
    }
    ++step_;
    time_s_ += dt_s;
    if (force_) {
        Gpu::Stage stage(gpu_, "force");
        force_->draw(phi_, u, diffusion, *voxels_, body_uniforms_, bodies,
                     results_.row());  // F = sum of (-p n + tau n) dA
    }
    if (wants_diagnosis) {
        Gpu::Stage stage(gpu_, "diagnose");
        diagnose(d);
    }
    {
        Gpu::Stage stage(gpu_, "read back");
        results_.request(step_, dt_s, wants_diagnosis);
    }
}

std::vector<Input> Yang2009Fluid::with_obstacles(std::vector<Input> inputs) const {
    if (voxels_) inputs.push_back({"obstacles", &voxels_->texture()});
    return inputs;
}

Field<Cells> Yang2009Fluid::advect_velocity() {
    Field<Cells> next(gpu_, setup_.cells, Format::RGBA32F);
    advect_velocity_.draw(with_obstacles({{"velocity", &u_.texture()}}),
                          {{"dt_h", static_cast<float>(dt_s_ / setup_.cell_m)}}, {&next.texture()});
    return next;
}

Field<Cells> Yang2009Fluid::drive_sources(Field<Cells> u) {
    for (const SourceSetup& source : setup_.sources) {
        if (!source.velocity_m_s || !is_running(source, time_s_)) continue;
        const glm::vec4 ball = ball_cells(source, setup_.cell_m);
        drive_->draw({}, {{"ball", ball}, {"ball_velocity", glm::vec3(*source.velocity_m_s)}}, {&u.texture()},
                     Region({ball_box(ball, setup_.cells)}));
    }
    return u;
}

Field<Cells> Yang2009Fluid::advect_smoke() {
    const Uniform dt_h{"dt_h", static_cast<float>(dt_s_ / setup_.cell_m)};
    const Uniform remains{"remains", static_cast<float>(std::exp(-setup_.smoke->dissipation_1_s * dt_s_))};
    const std::vector<Input> inputs{{"velocity", &u_.texture()}, {"smoke", &smoke_->texture()}};
    Field<Cells> next(gpu_, setup_.cells, Format::R32F);
    advect_smoke_->draw(inputs, {dt_h, remains}, {&next.texture()});
    if (smoke_sources_) {
        std::vector<glm::vec3> gains;
        for (const SourceSetup& source : setup_.sources)
            if (source.smoke_per_s > 0.0)
                gains.emplace_back(is_running(source, time_s_) ? dt_s_ * source.smoke_per_s : 0.0, 0.0, 0.0);
        smoke_sources_->draw(inputs, {dt_h, remains, {"source_ball", smoke_balls_}, {"source_gain", gains}},
                             {&next.texture()}, Region(smoke_boxes_));
    }
    return next;
}

Field<Cells> Yang2009Fluid::divergence(const Field<Cells>& u) {
    Field<Cells> d(gpu_, setup_.cells, Format::R32F);
    divergence_.draw(with_obstacles({{"velocity", &u.texture()}}), {}, {&d.texture()});
    return d;
}

Field<Cells> Yang2009Fluid::subtract_gradient(const Field<Cells>& u) {
    Field<Cells> next(gpu_, setup_.cells, Format::RGBA32F);
    project_.draw(with_obstacles({{"velocity", &u.texture()}, {"phi", &phi_.texture()}}), {},
                  {&next.texture()});
    return next;
}

void Yang2009Fluid::diagnose(const Field<Cells>& before) {
    const glm::ivec2 columns(setup_.cells.x, setup_.cells.y);
    if (!diagnose_) {
        Variant variant = obstacle_variant(voxels());
        variant.layouts.emplace_back("CELLS", u_.layout());
        if (smoke_) variant.defines.emplace_back("SMOKE", "");
        diagnose_.emplace(gpu_, "diagnose", "gles/yang2009/diagnose.frag",
                          AtlasLayout{{columns.x, columns.y, 1}, 1}, variant);
        reduce_diagnosis_.emplace(gpu_, "reduce diagnosis", columns, glm::ivec2(Results::width(setup_), 1),
                                  "vec4(1.0, 0.0, 0.0, 1.0)");
    }
    const Field<Cells> after = divergence(u_);
    const TexturePool::Lease sums = gpu_.textures().lease(columns, Format::RGBA32F);
    std::vector<Input> inputs = with_obstacles(
        {{"velocity", &u_.texture()}, {"divergence", &after.texture()}, {"before", &before.texture()}});
    if (smoke_) inputs.push_back({"smoke", &smoke_->texture()});
    diagnose_->draw(inputs, {}, {&*sums});
    reduce_diagnosis_->draw(*sums, results_.row(), Results::diagnosis_texel(setup_));
}

std::vector<glm::vec3> Yang2009Fluid::velocity() const {
    return unpack_vectors(u_.texture().download(), u_.layout());
}

std::vector<float> Yang2009Fluid::pressure() const {
    std::vector<float> p = unpack_scalars(phi_.texture().download(), phi_.layout());
    const double pascal = dt_s_ > 0.0 ? setup_.density_kg_m3 * setup_.cell_m / dt_s_ : 0.0;
    for (float& value : p) value = static_cast<float>(value * pascal);
    return p;
}

void Yang2009Fluid::set_velocity(const std::vector<glm::vec3>& u) {
    const std::vector<glm::vec4> texels = pack_vectors(u, u_.layout());
    u_.texture().upload(&texels[0].x);
}

}  // namespace eddy::gles
