#include "gles/fluid/cut_cell.h"

#include <fmt/format.h>

#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// More V-cycles for the first step, which has no pressure of the last one to start from: its force is an
/// impulse, and comes out right (2 cycles alone: 2 % low; 5: within 0.02 % of the converged one).
constexpr int kColdCycles = 3;

bool has_weight(const FluidSetup& setup) {
    return setup.smoke && setup.smoke->weight != 0.0;
}

bool is_lifted(const FluidSetup& setup) {
    return setup.temperature && setup.temperature->expansion_1_k != 0.0;
}

/// The body forces this scene has.
Variant force_variant(const FluidSetup& setup) {
    Variant v;
    v.layouts.emplace_back("CELL_CENTRES", Cells::layout(setup.cells));
    if (has_weight(setup)) v.defines.emplace_back("WEIGHT", "");
    if (is_lifted(setup)) v.defines.emplace_back("LIFT", "");
    if (setup.confinement_1_s > 0.0) v.defines.emplace_back("CONFINEMENT", "");
    if (setup.acceleration_m_s2) {
        const auto& f = setup.acceleration_m_s2->glsl;
        v.defines.emplace_back("FORCING", "");
        v.declarations =
            setup.formula_helpers + fmt::format(
                                        "uniform float time;  // [s]\nvec3 forcing(vec3 cells) {{\n{}    "
                                        "return vec3({}, {}, {});\n}}\n",
                                        formula_variables(setup.cell_m, "time"), f[0], f[1], f[2]);
    }
    return v;
}

/// The three layers of face texels at the upper walls.
Region upper_walls(const glm::ivec3& n) {
    return Region(
        {{{n.x, 0, 0}, n + 1}, {{0, n.y, 0}, {n.x, n.y + 1, n.z + 1}}, {{0, 0, n.z}, {n.x, n.y, n.z + 1}}});
}

}  // namespace

Variant CutCellFluid::grid_variant(bool cut) const {
    Variant v{.layouts = {{"FACES", Faces::layout(setup_.cells)},
                          {"PHI", Cells4::layout(setup_.cells)},
                          {"FRACTION", Faces4::layout(setup_.cells)}},
              .defines = {{"CELLS", glsl(setup_.cells)}}};
    walls_.declare(v);
    if (cut) {
        v.defines.emplace_back("CUT", "");
        v.declarations += shape_declarations(setup_.bodies);
    }
    return v;
}

CutCellFluid::Projection CutCellFluid::make_projection() {
    const auto make = [&](const char* suffix, bool cut, bool walls) {
        Variant variant = grid_variant(cut);
        if (walls) variant.defines.emplace_back("WALLS", "");
        return Pass(gpu_, std::string("project") + suffix, "gles/fluid/project.frag",
                    Faces::layout(setup_.cells), variant);
    };
    const bool solids = fractions_.has_value();
    return {make("", false, false), solids ? std::optional<Pass>(make(" cut", true, false)) : std::nullopt,
            make(" at walls", solids, true)};
}

CutCellFluid::CutCellFluid(Gpu& gpu, FluidSetup setup)
    : Fluid(std::move(setup)),
      gpu_(gpu),
      u_(gpu, setup_.cells, Format::RGBA32F),
      phi_(gpu, setup_.cells, Format::RGBA32F),
      walls_(setup_),
      advect_(gpu, setup_, walls_),
      fractions_(setup_.bodies.empty()
                     ? std::optional<Fractions>()
                     : std::optional<Fractions>(std::in_place, gpu, multigrid_levels(setup_.cells),
                                                setup_.bodies, setup_.cell_m)),
      body_uniforms_(gpu, setup_.bodies, setup_.cell_m),
      divergence_(gpu, "divergence", "gles/fluid/divergence.frag", Cells4::layout(setup_.cells),
                  grid_variant(false)),
      pressure_(gpu, setup_.cells, fractions_ ? &*fractions_ : nullptr, walls_,
                is_viscous() || setup_.solver.time_order == 2),
      project_(make_projection()),
      diagnosis_(gpu, setup_),
      results_(gpu, setup_) {
    if (fractions_)
        divergence_cut_.emplace(gpu, "divergence cut", "gles/fluid/divergence.frag",
                                Cells4::layout(setup_.cells), grid_variant(true));
    if (is_viscous()) {
        viscosity_.emplace(gpu, setup_, walls_);
        add_pressure_.emplace(gpu, "add pressure", "gles/fluid/add_pressure.frag",
                              Cells4::layout(setup_.cells));
    }
    if (setup_.solver.time_order == 2) reflection_.emplace(gpu, setup_);
    if (Coupling::needed(setup_)) coupling_.emplace(gpu, setup_, pressure_, body_uniforms_);
    if (Results::measures(setup_)) traction_.emplace(gpu, setup_, Results::width(setup_));
    if (setup_.force_methods && fractions_) force_methods_.emplace(gpu, setup_);
    const Fractions* solids = fractions_ ? &*fractions_ : nullptr;
    if (const auto smoke = Scalar::smoke(setup_)) smoke_.emplace(gpu, setup_, *smoke, walls_, solids);
    if (const auto heat = Scalar::temperature(setup_))
        temperature_.emplace(gpu, setup_, *heat, walls_, solids);
    for (const SourceSetup& source : setup_.sources)
        if (source.velocity_m_s && !drive_)
            drive_.emplace(gpu, "drive sources", "gles/fluid/drive.frag", Faces::layout(setup_.cells),
                           Variant{});
    if (setup_.gravity_m_s2 != glm::dvec3(0.0) || setup_.acceleration_m_s2 || setup_.confinement_1_s > 0.0)
        body_forces_.emplace(gpu, "body forces", "gles/fluid/body_forces.frag", Faces::layout(setup_.cells),
                             force_variant(setup_));
    if (setup_.confinement_1_s > 0.0) {
        const AtlasLayout cells = Cells::layout(setup_.cells);
        vorticity_.emplace(gpu, "vorticity", "gles/fluid/vorticity.frag", cells, grid_variant(false));
        confinement_.emplace(gpu, "confinement", "gles/fluid/confinement.frag", cells);
    }
    reset();
}

std::vector<glm::vec3> CutCellFluid::velocity_at_start() const {
    if (!setup_.velocities_at_start.empty()) return setup_.velocities_at_start;
    const glm::ivec3 n = setup_.cells;
    std::vector<glm::vec3> u(static_cast<std::size_t>((n.x + 1) * (n.y + 1) * (n.z + 1)), glm::vec3(0.0f));
    if (!setup_.velocity_at_start) return u;
    std::size_t i = 0;
    for (int z = 0; z <= n.z; ++z)
        for (int y = 0; y <= n.y; ++y)
            for (int x = 0; x <= n.x; ++x, ++i) {
                // Beyond an upper wall: a copy of the last row before it, as velocity.glsl has it.
                const glm::dvec3 wall(x, y, z), row = glm::min(wall, glm::dvec3(n) - 1.0);
                const auto on_face = [&](const glm::dvec3& face) {
                    const glm::dvec3 corner = glm::mix(wall, row, 2.0 * face);
                    return setup_.velocity_at_start(setup_.cell_m * (corner + face));
                };
                u[i] = glm::vec3(on_face({0.0, 0.5, 0.5}).x, on_face({0.5, 0.0, 0.5}).y,
                                 on_face({0.5, 0.5, 0.0}).z);
            }
    return u;
}

void CutCellFluid::reset() {
    set_velocity(velocity_at_start());
    clear(phi_.texture());
    if (smoke_) smoke_->reset();
    if (temperature_) temperature_->reset();
    results_.forget();
    bodies_.clear();
    if (coupling_) coupling_->reset();
    if (force_methods_) force_methods_->reset();
    dt_s_ = 0.0;
    step_ = 0;
    time_s_ = 0.0;
}

void CutCellFluid::step(double dt_s, const std::vector<BodyState>& given, bool wants_diagnosis) {
    // phi ~ dt p; before the first step there is none.
    const float guess_scale = dt_s_ > 0.0 ? static_cast<float>(dt_s / dt_s_) : 1.0f;
    dt_s_ = dt_s;
    std::vector<BodyState> bodies =
        coupling_ ? coupling_->predict(given, bodies_, dt_s) : given;  // x = x + dt U
    const double start_s = time_s_, end_s = time_s_ + dt_s;
    std::optional<Reflection::Middle> middle;
    if (reflection_) middle = go_to_the_middle(half_a_step_before(bodies, dt_s), 0.5f * guess_scale);
    const double part_s = reflection_ ? 0.5 * dt_s : dt_s;  // of the step, from here on
    Pressure::Work work = place(bodies);
    work.guess_scale = guess_scale;
    Field<Faces> u;
    {
        Gpu::Stage stage(gpu_, "advect velocity");
        keep(&StepVelocities::before, u_);
        u = advect_(middle ? middle->mirrored : u_, u_, part_s, walls_.time(time_s_));  // u* = u(x - dt u)
        keep(&StepVelocities::carried, u);
        u = drive_sources(std::move(u));
    }
    if (smoke_) smoke_->step(u_, start_s, dt_s, walls_.time(time_s_));  // s = s(x - dt u) + dt q
    if (temperature_)
        temperature_->step(u_, start_s, dt_s,
                           walls_.time(time_s_));  // T - kappa dt lap T = T(x - dt u) + dt q
    if (body_forces_) {
        Gpu::Stage stage(gpu_, "body forces");
        u = add_body_forces(u, end_s, part_s);  // u* += dt (g (1 + w s - beta T) + f)
    }
    keep(&StepVelocities::forced, u);
    time_s_ = end_s;
    if (!reflection_) {
        Gpu::Stage stage(gpu_, "pressure");
        phi_ = pressure_.follow(std::move(phi_), motions(bodies));
    }
    if (viscosity_) {
        Gpu::Stage stage(gpu_, "viscosity");
        diffused_ = diffuse(u, work);  // u** - nu dt lap u** = u* - grad phi
        keep(&StepVelocities::diffused, diffused_);
    }
    const Field<Faces>& u_star = viscosity_ ? diffused_ : u;
    Field<Cells4> b;
    {
        Gpu::Stage stage(gpu_, "divergence");
        b = divergence(u_star);  // b = div (a u* + (1 - a) u_solid)
    }
    {
        Gpu::Stage stage(gpu_, "pressure");
        phi_ = solve_pressure(b, work);  // div (a grad phi) = b
    }
    if (coupling_) {
        Gpu::Stage stage(gpu_, "coupling");
        couple(bodies);  // M dU/dt = F + weight; phi += sum dU_k phi_k
    }
    {
        Gpu::Stage stage(gpu_, "project");
        u_ = project(u_star, increment_ ? increment_ : phi_, 1.0f);  // u = u* - grad phi
    }
    ++step_;
    if (traction_) {
        Gpu::Stage stage(gpu_, "force");
        traction_->draw(reflection_ ? increment_ : phi_, fractions_->level(0), body_uniforms_, bodies, boxes_,
                        reflection_ ? reflection_->second_loads() : results_.row(),
                        friction());  // F = int p grad(1 - a) + mu du/dn
        if (reflection_) reflection_->add_loads(results_.row());
    }
    if (force_methods_) {
        Gpu::Stage stage(gpu_, "force methods");
        keep(&StepVelocities::after, u_);
        force_methods_->add_up(phi_, fractions_->level(0), body_uniforms_, boxes_, time_s_, dt_s);
    }
    if (wants_diagnosis) {
        Gpu::Stage stage(gpu_, "diagnose");
        diagnosis_.draw({u_, middle ? middle->divergence : b, divergence(u_), smoke(), temperature()},
                        results_.row());
    }
    if (traction_ || wants_diagnosis) {
        Gpu::Stage stage(gpu_, "read back");
        results_.request(step_, dt_s, wants_diagnosis);
    }
    bodies_ = std::move(bodies);
}

void CutCellFluid::keep(ForceMethodsPass::Which which, const Field<Faces>& u) {
    if (force_methods_) force_methods_->keep(which, u);
}

Pressure::Work CutCellFluid::place(const std::vector<BodyState>& bodies) {
    body_uniforms_.set(bodies);
    boxes_.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        boxes_.push_back(body_box(setup_.bodies[i], bodies[i], setup_.cell_m, setup_.cells));
    if (fractions_) {
        Gpu::Stage stage(gpu_, "voxelise");
        fractions_->update(body_uniforms_, boxes_);  // a, where the bodies are now
        if (viscosity_) viscosity_->place(body_uniforms_, boxes_, fractions_->level(0));
    }
    Pressure::Work work{
        .cycles = setup_.solver.cycles + (step_ == 0 ? kColdCycles : 0), .cut = boxes_, .rough = boxes_};
    for (const SourceSetup& source : setup_.sources)
        if (source.velocity_m_s && is_running(source, time_s_))
            work.rough.push_back(ball_box(ball_cells(source, setup_.cell_m), setup_.cells));
    return work;
}

Reflection::Middle CutCellFluid::go_to_the_middle(const std::vector<BodyState>& bodies, float guess_scale) {
    const double half_s = 0.5 * dt_s_;
    Pressure::Work work = place(bodies);
    work.guess_scale = guess_scale;
    Field<Faces> u;
    {
        Gpu::Stage stage(gpu_, "advect velocity");
        u = drive_sources(advect_(u_, u_, half_s, walls_.time(time_s_)));
    }
    if (body_forces_) {
        Gpu::Stage stage(gpu_, "body forces");
        u = add_body_forces(u, time_s_,
                            half_s);  // of the smoke and heat at the start; the second half: at the end
    }
    time_s_ += half_s;
    Field<Cells4> b;
    {
        Gpu::Stage stage(gpu_, "divergence");
        b = divergence(u);
    }
    {
        Gpu::Stage stage(gpu_, "pressure");
        std::vector<Displacement> since = motions(bodies);
        for (Displacement& body : since) body.moved *= 2.0f;  // since the middle of the last step
        phi_ = pressure_.solve(pressure_.follow(std::move(phi_), since), b, work);
    }
    {
        Gpu::Stage stage(gpu_, "project");
        u_ = project(u, phi_, 1.0f);
    }
    if (traction_) {
        Gpu::Stage stage(gpu_, "force");
        traction_->draw(phi_, fractions_->level(0), body_uniforms_, bodies, boxes_,
                        reflection_->first_loads(), std::nullopt);
    }
    Gpu::Stage stage(gpu_, "reflect");
    return {reflection_->mirror(u_, u), std::move(b)};
}

Field<Faces> CutCellFluid::add_body_forces(const Field<Faces>& u, double time_s, double dt_s) {
    Field<Faces> next(gpu_, setup_.cells, Format::RGBA32F);
    std::vector<Input> inputs{{"velocity", &u.texture()}};
    std::vector<Uniform> uniforms{{"dt", static_cast<float>(dt_s)},
                                  {"gravity", glm::vec3(setup_.gravity_m_s2)},
                                  {"time", static_cast<float>(time_s)}};
    if (has_weight(setup_)) {
        inputs.push_back({"smoke", &smoke_->field().texture()});
        uniforms.push_back({"weight", static_cast<float>(setup_.smoke->weight)});
    }
    if (is_lifted(setup_)) {
        inputs.push_back({"temperature", &temperature_->field().texture()});
        uniforms.push_back({"expansion", static_cast<float>(setup_.temperature->expansion_1_k)});
    }
    Field<Cells> swirl;
    if (confinement_) {
        const Field<Cells> vorticity(gpu_, setup_.cells, Format::RGBA32F);
        swirl = Field<Cells>(gpu_, setup_.cells, Format::RGBA32F);
        vorticity_->draw({{"velocity", &u.texture()}}, {}, {&vorticity.texture()});
        confinement_->draw({{"vorticity", &vorticity.texture()}},
                           {{"strength", static_cast<float>(setup_.confinement_1_s)}}, {&swirl.texture()});
        inputs.push_back({"swirl", &swirl.texture()});
    }
    body_forces_->draw(inputs, uniforms, {&next.texture()});
    return next;
}

Field<Faces> CutCellFluid::diffuse(const Field<Faces>& u, const Pressure::Work& work) {
    // No pressure yet: without one the viscous step would take a fluid held by gravity for one that falls.
    if (step_ == 0) phi_ = pressure_.solve(divergence(u), work);
    const Field<Faces> predicted = project(u, phi_, work.guess_scale);
    keep(&StepVelocities::predicted, predicted);
    // The last step's result is a better guess than this step's right-hand side: at rest in a steady flow it is the
    // solution, whatever the cycles leave.
    return viscosity_->diffuse(step_ == 0 ? predicted : diffused_, predicted, dt_s_,
                               setup_.solver.viscous_cycles, walls_.time(time_s_));
}

Field<Cells4> CutCellFluid::solve_pressure(const Field<Cells4>& b, const Pressure::Work& work) {
    if (!viscosity_ && !reflection_) return pressure_.solve(std::move(phi_), b, work);
    increment_ = pressure_.solve(b, work);
    if (reflection_) return reflection_->add(phi_, increment_);
    Field<Cells4> phi(gpu_, setup_.cells, Format::RGBA32F);
    add_pressure_->draw({{"phi", &phi_.texture()}, {"increment", &increment_.texture()}, {"b", &b.texture()}},
                        {{"scale", work.guess_scale}, {"lambda", diffusion_number(setup_, dt_s_)}},
                        {&phi.texture()});
    return phi;
}

std::optional<Traction::Friction> CutCellFluid::friction() const {
    if (!viscosity_) return std::nullopt;
    return Traction::Friction{diffused_, *viscosity_->grip(), diffusion_number(setup_, dt_s_)};
}

void CutCellFluid::couple(std::vector<BodyState>& bodies) {
    coupling_->solve(bodies, {phi_, fractions_->level(0), boxes_, motions(bodies), friction(), dt_s_});
    phi_ = coupling_->add_to(std::move(phi_));
    if (viscosity_) increment_ = coupling_->add_to(std::move(increment_));
}

std::vector<Displacement> CutCellFluid::motions(const std::vector<BodyState>& bodies) const {
    std::vector<Displacement> result;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Ball ball = bounding_ball(setup_.bodies[i].shape);
        const auto middle = [&](const BodyState& state) {
            return (state.centre_m + state.orientation * ball.centre_m) / setup_.cell_m;
        };
        result.push_back({glm::vec3(middle(bodies[i])), glm::vec3(middle(bodies[i]) - middle(bodies_[i])),
                          static_cast<float>(ball.radius_m / setup_.cell_m)});
    }
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

void CutCellFluid::add_solids(std::vector<Input>& inputs, std::vector<Uniform>& uniforms) const {
    const std::vector<Input> a = fractions_->level(0).inputs();
    inputs.insert(inputs.end(), a.begin(), a.end());
    inputs.insert(inputs.end(), body_uniforms_.inputs().begin(), body_uniforms_.inputs().end());
    const std::vector<Uniform> of_bodies = body_uniforms_.uniforms();
    uniforms.insert(uniforms.end(), of_bodies.begin(), of_bodies.end());
}

Field<Cells4> CutCellFluid::divergence(const Field<Faces>& u) {
    Field<Cells4> b(gpu_, setup_.cells, Format::RGBA32F);
    std::vector<Input> inputs{{"velocity", &u.texture()}};
    std::vector<Uniform> uniforms{walls_.time(time_s_)};
    divergence_.draw(inputs, uniforms, {&b.texture()});
    if (fractions_) {
        add_solids(inputs, uniforms);
        divergence_cut_->draw(inputs, uniforms, {&b.texture()}, Region::packed(boxes_));
    }
    return b;
}

Field<Faces> CutCellFluid::project(const Field<Faces>& u, const Field<Cells4>& phi, float scale) {
    Field<Faces> next(gpu_, setup_.cells, Format::RGBA32F);
    std::vector<Input> inputs{{"velocity", &u.texture()}, {"phi", &phi.texture()}};
    std::vector<Uniform> uniforms{{"scale", scale}, walls_.time(time_s_)};
    project_.plain.draw(inputs, uniforms, {&next.texture()});
    if (fractions_) {
        add_solids(inputs, uniforms);
        project_.cut->draw(inputs, uniforms, {&next.texture()}, Region(boxes_));
    }
    project_.walls.draw(inputs, uniforms, {&next.texture()}, upper_walls(setup_.cells));
    return next;
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
