#include "gles/fluid/cut_cell.h"

#include <algorithm>
#include <stdexcept>

#include "gles/body/displacement.h"
#include "gles/fluid/velocity_at_start.h"
#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// More V-cycles for the first step, which has no pressure of the last one to start from: its force is an
/// impulse, and comes out right (2 cycles alone: 2 % low; 5: within 0.02 % of the converged one). So is that of a step in which
/// an inflow begins or ends.
constexpr int kColdCycles = 3;

/// A step more than so many times as long as the last begins anew; what a clock jitters (case 2) comes to 25.
constexpr float kLongerThanTheLast = 30.0f;

/// The setup, if there is a step for it.
FluidSetup possible(FluidSetup setup) {
    if (setup.solver.time_order == 2 &&
        (setup.viscosity_pa_s > 0.0 || Coupling::needed(setup) || setup.force_methods))
        throw std::logic_error(
            "a fluid of second order in time was given viscosity, bodies that it moves, or force_methods");
    return setup;
}

}  // namespace

CutCellFluid::CutCellFluid(Gpu& gpu, FluidSetup setup)
    : Fluid(possible(std::move(setup))),
      gpu_(gpu),
      u_(gpu, setup_.cells, Format::RGBA32F),
      phi_(gpu, setup_.cells, Format::RGBA32F),
      walls_(setup_),
      advect_(gpu, setup_, walls_),
      jets_(gpu, setup_),
      fractions_(setup_.bodies.empty()
                     ? std::optional<Fractions>()
                     : std::optional<Fractions>(std::in_place, gpu, multigrid_levels(setup_.cells),
                                                setup_.bodies, setup_.cell_m)),
      body_uniforms_(gpu, setup_.bodies, setup_.cell_m),
      pressure_(gpu, setup_.cells, fractions_ ? &*fractions_ : nullptr, walls_,
                is_viscous() || setup_.solver.time_order == 2),
      projection_(gpu, setup_, walls_, fractions_ ? &*fractions_ : nullptr, body_uniforms_),
      health_(gpu, setup_, u_.layout(), phi_.layout()),
      diagnosis_(gpu, setup_),
      results_(gpu, setup_) {
    if (is_viscous()) {
        viscosity_.emplace(gpu, setup_, walls_);
        Variant variant{.defines = {{"CELLS", glsl(setup_.cells)}}};
        walls_.declare(variant);
        add_pressure_.emplace(gpu, "add pressure", "gles/fluid/add_pressure.frag",
                              Cells4::layout(setup_.cells), variant);
    }
    if (setup_.solver.time_order == 2) reflection_.emplace(gpu, setup_);
    if (Coupling::needed(setup_)) coupling_.emplace(gpu, setup_, pressure_, body_uniforms_);
    if (Results::measures(setup_)) traction_.emplace(gpu, setup_, Results::width(setup_));
    if (setup_.force_methods && fractions_) force_methods_.emplace(gpu, setup_);
    const Fractions* solids = fractions_ ? &*fractions_ : nullptr;
    if (const auto smoke = Scalar::smoke(setup_)) smoke_.emplace(gpu, setup_, *smoke, walls_, solids);
    if (const auto heat = Scalar::temperature(setup_))
        temperature_.emplace(gpu, setup_, *heat, walls_, solids);
    if (fractions_) pressure_level_.emplace(gpu, setup_);
    if (Confinement::needed(setup_)) confinement_.emplace(gpu, setup_);
    if (TransportEnergy::needed(setup_)) transport_energy_.emplace(gpu, setup_);
    if (BodyForces::needed(setup_)) body_forces_.emplace(gpu, setup_);
    start_over();
}

void CutCellFluid::start_over() {
    set_velocity(velocity_at_start(setup_));
    clear(phi_.texture());
    diffused_ = {};
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

void CutCellFluid::move_on(double dt_s, const std::vector<BodyState>& given, bool wants_diagnosis) {
    sound_ = sound(setup_, dt_s);
    health_.draw(
        {&u_.texture(), &phi_.texture(), diffused_ ? &diffused_.texture() : nullptr, smoke(), temperature()},
        sound_, results_.row());
    // phi ~ dt p; before the first step there is none.
    guess_scale_ = dt_s_ > 0.0 ? static_cast<float>(dt_s / dt_s_) : 1.0f;
    // guard short_step: in next to no time the pressure is that of a blow, and says nothing of a step so much longer
    if (guess_scale_ > kLongerThanTheLast) guess_scale_ = 0.0f;
    dt_s_ = dt_s;
    std::vector<BodyState> bodies =
        coupling_ ? coupling_->predict(given, bodies_, dt_s) : given;  // x = x + dt U
    driven_.go_on(bodies, time_s_, dt_s);
    const double start_s = time_s_;
    Field<Cells4> b;
    if (reflection_) {
        std::vector<BodyState> halfway = half_a_step_before(bodies, dt_s);
        b = advance(Part::FirstHalf, start_s, halfway);
        advance(Part::SecondHalf, start_s, bodies);
        mirrored_ = {};
    } else {
        b = advance(Part::Whole, start_s, bodies);
    }
    ++step_;
    if (force_methods_) {
        Gpu::Stage stage(gpu_, "force methods");
        keep(&StepVelocities::after, u_);
        force_methods_->add_up(phi_, fractions_->level(0), body_uniforms_, boxes_, time_s_, dt_s);
    }
    if (wants_diagnosis) {
        Gpu::Stage stage(gpu_, "diagnose");
        // What the guard against gaps leaves is a divergence too.
        const Field<Cells4> left = projection_.divergence(u_, kNoLimit, boxes_, walls_.time(time_s_));
        diagnosis_.draw({u_, b, left, smoke(), temperature()}, results_.row());
    }
    {
        Gpu::Stage stage(gpu_, "read back");
        results_.request(step_, dt_s, wants_diagnosis);
    }
    bodies_ = std::move(bodies);
}

Field<Cells4> CutCellFluid::advance(Part part, double start_s, std::vector<BodyState>& bodies) {
    const bool first_half = part == Part::FirstHalf, second_half = part == Part::SecondHalf;
    const double dt_s = part == Part::Whole ? dt_s_ : 0.5 * dt_s_;
    const double end_s = first_half ? start_s + dt_s : start_s + dt_s_;
    Pressure::Work work = place(bodies, first_half ? 0.5f * guess_scale_ : guess_scale_);
    Field<Faces> u;
    {
        Gpu::Stage stage(gpu_, "advect velocity");
        keep(&StepVelocities::before, u_);
        u = advect_(second_half ? mirrored_ : u_, u_, dt_s, walls_.time(time_s_));  // u* = u(x - dt u)
        keep(&StepVelocities::carried, u);
    }
    if (transport_energy_ && TransportEnergy::acts(diffusion_number(setup_, dt_s_))) {
        Gpu::Stage stage(gpu_, "transport energy");
        u = transport_energy_->keep(std::move(u), second_half ? mirrored_ : u_);  // sum |u*|^2 <= sum |u|^2
    }
    if (confinement_) {
        Gpu::Stage stage(gpu_, "confinement");
        u = confinement_->add_to(u, driven_.lately_m_s(), dt_s);  // u* += dt eps h (N x w)
    }
    if (jets_.any()) {
        Gpu::Stage stage(gpu_, "drive sources");
        u = jets_.drive(std::move(u), time_s_);  // u* = u_source in the balls of the sources
    }
    if (smoke_ && !first_half)
        smoke_->step(u_, start_s, dt_s_, walls_.time(time_s_));  // s = s(x - dt u) + dt q
    if (temperature_ && !first_half)
        temperature_->step(u_, start_s, dt_s_,
                           walls_.time(time_s_));  // T - kappa dt lap T = T(x - dt u) + dt q
    if (body_forces_) {
        Gpu::Stage stage(gpu_, "body forces");
        // u* += dt (g (1 + w s - beta T) + f); of the halves, one has s, T and f of the step's start, one of its end
        u = body_forces_->add_to(u, smoke(), temperature(), first_half ? start_s : end_s, dt_s);
    }
    keep(&StepVelocities::forced, u);
    time_s_ = end_s;
    if (!second_half) {
        Gpu::Stage stage(gpu_, "pressure");
        if (pressure_level_) phi_ = pressure_level_->put_right(phi_, fractions_->level(0), sound_.most_phi);
        phi_ = pressure_.follow(std::move(phi_), since_last_pressure(part, bodies), sound_.most_phi);
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
        phi_ = solve_pressure(part, b, work);  // div (a grad phi) = b
    }
    if (coupling_) {
        Gpu::Stage stage(gpu_, "coupling");
        couple(bodies);  // M dU/dt = F + weight; phi += sum dU_k phi_k
    }
    {
        Gpu::Stage stage(gpu_, "project");
        u_ = project(u_star, increment_ ? increment_ : phi_, 1.0f);  // u = u* - grad phi
    }
    if (traction_) {
        Gpu::Stage stage(gpu_, "force");
        traction_->draw(second_half ? increment_ : phi_, fractions_->level(0), body_uniforms_, bodies, boxes_,
                        reflection_ ? reflection_->loads(part) : results_.row(),
                        friction());  // F = int p grad(1 - a) + mu du/dn
        if (second_half) reflection_->add_loads(results_.row());
    }
    if (first_half) {
        Gpu::Stage stage(gpu_, "reflect");
        mirrored_ = reflection_->mirror(u_, u_star);  // 2 u - u*
    }
    return b;
}

void CutCellFluid::keep(ForceMethodsPass::Which which, const Field<Faces>& u) {
    if (force_methods_) force_methods_->keep(which, u);
}

Pressure::Work CutCellFluid::place(const std::vector<BodyState>& bodies, float guess_scale) {
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
        .cycles = setup_.solver.cycles +
                  (step_ == 0 || guess_scale == 0.0f || driven_.is_sudden() ? kColdCycles : 0),
        .guess_scale = guess_scale,
        .most_phi = sound_.most_phi,
        .cut = boxes_,
        .rough = boxes_};
    const std::vector<Box> jets = jets_.boxes(time_s_);
    work.rough.insert(work.rough.end(), jets.begin(), jets.end());
    return work;
}

std::vector<Displacement> CutCellFluid::since_last_pressure(Part part,
                                                            const std::vector<BodyState>& bodies) const {
    std::vector<Displacement> since = displacements(setup_, bodies_, bodies);
    // The pressure of a step in halves is that of its middle.
    if (part == Part::FirstHalf)
        for (Displacement& body : since) body.moved *= 2.0f;
    return since;
}

Field<Faces> CutCellFluid::diffuse(const Field<Faces>& u, Pressure::Work& work) {
    // No pressure yet, or none that says anything: without one the viscous step would take a fluid held by gravity for one that falls.
    if (step_ == 0 || work.guess_scale == 0.0f) {
        phi_ = pressure_.solve(divergence(u), work);
        work.guess_scale = 1.0f;
    }
    // What passes gaps is limited when friction has acted, not before: until then a pressure that drives thick fluid has no match.
    const Field<Faces> predicted = projection_.project(
        u, phi_, work.guess_scale, {.most_phi = sound_.most_phi}, boxes_, walls_.time(time_s_));
    keep(&StepVelocities::predicted, predicted);
    // The last step's result is a better guess than this step's right-hand side: at rest in a steady flow it is the
    // solution, whatever the cycles leave.
    return viscosity_->diffuse(step_ == 0 ? predicted : diffused_, sound_.fastest_m_s, predicted, dt_s_,
                               setup_.solver.viscous_cycles, walls_.time(time_s_));
}

Field<Cells4> CutCellFluid::solve_pressure(Part part, const Field<Cells4>& b, const Pressure::Work& work) {
    if (!viscosity_ && part != Part::SecondHalf) {
        increment_ = {};
        return pressure_.solve(std::move(phi_), b, work);
    }
    increment_ = pressure_.solve(b, work);
    if (part == Part::SecondHalf) return reflection_->add(phi_, increment_);
    Field<Cells4> phi(gpu_, setup_.cells, Format::RGBA32F);
    add_pressure_->draw({{"phi", &phi_.texture()}, {"increment", &increment_.texture()}, {"b", &b.texture()}},
                        {{"scale", work.guess_scale},
                         {"most_phi", work.most_phi},
                         {"lambda", diffusion_number(setup_, dt_s_)}},
                        {&phi.texture()});
    return phi;
}

std::optional<Traction::Friction> CutCellFluid::friction() const {
    if (!viscosity_) return std::nullopt;
    return Traction::Friction{diffused_, *viscosity_->grip(), diffusion_number(setup_, dt_s_)};
}

void CutCellFluid::couple(std::vector<BodyState>& bodies) {
    coupling_->solve(bodies, {phi_, fractions_->level(0), boxes_, displacements(setup_, bodies_, bodies),
                              friction(), dt_s_});
    phi_ = coupling_->add_to(std::move(phi_));
    if (viscosity_) increment_ = coupling_->add_to(std::move(increment_));
}

Field<Cells4> CutCellFluid::divergence(const Field<Faces>& u) {
    return projection_.divergence(u, driven_.through_gaps_m_s(dt_s_), boxes_, walls_.time(time_s_));
}

Field<Faces> CutCellFluid::project(const Field<Faces>& u, const Field<Cells4>& phi, float scale) {
    return projection_.project(u, phi, scale, {.through_gaps_m_s = driven_.through_gaps_m_s(dt_s_)}, boxes_,
                               walls_.time(time_s_));
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
    double fastest = 0.0;
    for (const glm::vec3& v : u)
        fastest = std::max(fastest, static_cast<double>(glm::length(v)));  // not if it is nan
    driven_.start(fastest);
    const std::vector<glm::vec4> texels = pack_vectors(u, u_.layout());
    u_.texture().upload(&texels[0].x);
}

}  // namespace eddy::gles
