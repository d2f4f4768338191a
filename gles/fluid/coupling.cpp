#include "gles/fluid/coupling.h"

#include <algorithm>
#include <cmath>

#include "gles/fluid/resistance.h"
#include "gles/fluid/step_guard.h"
#include "gles/grid_io.h"

namespace eddy::gles {
namespace {

/// V-cycles that improve a potential in a step, and more in the first, which starts from 0.
constexpr int kCycles = 1, kColdCycles = 4;

bool is_round(const BodySetup& body) {
    return std::holds_alternative<Sphere>(body.shape);
}

/// Loads of the coupled bodies are measured, whatever the scene asks for; no others.
FluidSetup measuring_coupled(FluidSetup setup) {
    for (BodySetup& body : setup.bodies) body.force = body.torque = body.coupled.has_value();
    return setup;
}

FluidSetup without_friction(FluidSetup setup) {
    setup.viscosity_pa_s = 0.0;
    return setup;
}

int width_of_loads(const FluidSetup& setup) {
    return 2 * static_cast<int>(setup.bodies.size());
}

/// Numbers of the loads a step adds up: of the pressure, of the hydrostatic one, and of potential k.
constexpr std::size_t kPressure = 0, kHydrostatic = 1, kPotentials = 2;

int width(const FluidSetup& setup) {
    const auto coupled = std::count_if(setup.bodies.begin(), setup.bodies.end(),
                                       [](const BodySetup& body) { return body.coupled.has_value(); });
    return width_of_loads(setup) * (static_cast<int>(kPotentials) + 6 * static_cast<int>(coupled));
}

Variant unit_flux(const FluidSetup& setup) {
    return {.layouts = {{"FACES", Faces::layout(setup.cells)}, {"FRACTION", Faces4::layout(setup.cells)}},
            .defines = {{"CELLS", glsl(setup.cells)}, {"CUT", ""}, {"AT_REST", ""}},
            .declarations = shape_declarations(setup.bodies)};
}

Field<Cells4> hydrostatic(Gpu& gpu, const FluidSetup& setup) {
    Field<Cells4> phi(gpu, setup.cells, Format::RGBA32F);
    const AtlasLayout layout = phi.layout();
    const glm::ivec2 size = layout.texels();
    std::vector<glm::vec4> texels(static_cast<std::size_t>(size.x * size.y), glm::vec4(0.0f));
    for (int slab = 0; slab < layout.size.z; ++slab)
        for (int y = 0; y < layout.size.y; ++y)
            for (int x = 0; x < layout.size.x; ++x)
                for (int lane = 0; lane < 4; ++lane) {
                    const glm::ivec2 t = layout.texel({x, y, slab});
                    const glm::dvec3 from_middle =
                        glm::dvec3(x, y, 4 * slab + lane) + 0.5 - 0.5 * glm::dvec3(setup.cells);
                    texels[static_cast<std::size_t>(t.y * size.x + t.x)][lane] =
                        static_cast<float>(glm::dot(setup.gravity_m_s2, from_middle));
                }
    phi.texture().upload(&texels[0].x);
    return phi;
}

}  // namespace

/// What came back: impulses in units of rho h^3 m/s, their moments in rho h^4 m/s.
struct Coupling::Sums {
    std::vector<glm::vec4> texels;
    std::size_t bodies;

    bool are_finite() const {
        return std::all_of(texels.begin(), texels.end(),
                           [](const glm::vec4& t) { return std::isfinite(t.x + t.y + t.z + t.w); });
    }

    /// Load number `load`; component 0 to 2: force, 3 to 5: torque.
    double operator()(std::size_t load, std::size_t body, std::size_t component) const {
        const glm::vec4& texel = texels[2 * (load * bodies + body) + component / 3];
        return static_cast<double>(texel[static_cast<glm::length_t>(component % 3)]);
    }
};

bool Coupling::needed(const FluidSetup& setup) {
    return std::any_of(setup.bodies.begin(), setup.bodies.end(),
                       [](const BodySetup& body) { return body.coupled.has_value(); });
}

Coupling::Coupling(Gpu& gpu, const FluidSetup& setup, Pressure& pressure, BodyUniforms& uniforms)
    : gpu_(gpu),
      setup_(setup),
      pressure_(pressure),
      uniforms_(uniforms),
      contacts_(setup),
      unknowns_(setup.bodies.size()),
      flux_(gpu, "flux of unit velocity", "gles/fluid/divergence.frag", Cells4::layout(setup.cells),
            unit_flux(setup)),
      add_(gpu, "add potentials", "gles/fluid/add_potentials.frag", Cells4::layout(setup.cells)),
      b_(gpu, setup.cells, Format::RGBA32F),
      pressing_(gpu, without_friction(measuring_coupled(setup)), width(setup)),
      row_(gpu.textures().lease({width(setup), 1}, Format::RGBA32F)),
      readback_(gpu, {width(setup), 1}) {
    for (std::size_t i = 0; i < setup.bodies.size(); ++i) {
        const BodySetup& body = setup.bodies[i];
        if (!body.coupled) continue;
        bodies_.push_back({i, RigidBody(body.shape, body.coupled->density_kg_m3),
                           body.coupled->density_kg_m3 / setup.density_kg_m3});
        for (const bool turns : {false, true}) {
            const bool pressed = !turns || !is_round(body);
            if (!(turns ? body.coupled->turns : body.coupled->moves)) continue;
            if (!pressed && setup.viscosity_pa_s == 0.0) continue;  // nothing can turn it
            Triple& triple = triples_.emplace_back();
            triple.body = bodies_.size() - 1;
            triple.turns = turns;
            (turns ? unknowns_[i].spin : unknowns_[i].velocity) = 3 * (triples_.size() - 1);
            for (int axis = 0; pressed && axis < 3; ++axis)
                triple.potentials.emplace_back(gpu, setup.cells, Format::RGBA32F);
        }
    }
    if (setup.viscosity_pa_s > 0.0) rubbing_.emplace(gpu, measuring_coupled(setup), width(setup));
    if (setup.gravity_m_s2 != glm::dvec3(0.0)) hydrostatic_ = hydrostatic(gpu, setup);
    reset();
}

void Coupling::reset() {
    clear(b_.texture());
    clear(*row_.get());
    for (Triple& triple : triples_) {
        for (Field<Cells4>& phi : triple.potentials) clear(phi.texture());
        triple.trust = glm::dvec3(1.0);
        triple.acceleration = glm::dvec3(0.0);
    }
    boxes_before_.clear();
    cold_ = true;
}

bool Coupling::solves_for_the_same_as(const Coupling& other) const {
    const auto same = [](const Triple& a, const Triple& b) {
        return a.body == b.body && a.turns == b.turns && a.potentials.size() == b.potentials.size();
    };
    return std::equal(triples_.begin(), triples_.end(), other.triples_.begin(), other.triples_.end(), same);
}

bool Coupling::copy(const Coupling& from, Resample& resample) {
    if (!solves_for_the_same_as(from)) return false;
    for (std::size_t t = 0; t < triples_.size(); ++t) {
        Triple& to = triples_[t];
        const Triple& of = from.triples_[t];
        for (std::size_t axis = 0; axis < to.potentials.size(); ++axis)
            to.potentials[axis] = resample.in_fours(of.potentials[axis], 1.0f);
        to.acceleration = of.acceleration;
        to.trust = of.trust;
    }
    cold_ = from.cold_;
    return true;
}

void Coupling::start(const Coupling* from, const std::vector<BodyState>& states, const FaceFractions& a,
                     const std::vector<Box>& boxes) {
    reset();
    if (from && solves_for_the_same_as(*from))
        for (std::size_t t = 0; t < triples_.size(); ++t) {
            const double gain = triples_[t].turns ? setup_.cell_m / from->setup_.cell_m : 1.0;
            triples_[t].acceleration = gain * from->triples_[t].acceleration;
            triples_[t].trust = from->triples_[t].trust;
        }
    draw_potentials(states, a, boxes, {});
    uniforms_.set(states);
}

std::vector<BodyState> Coupling::predict(const std::vector<BodyState>& given,
                                         const std::vector<BodyState>& before, double dt_s) {
    before_ = before.empty() ? given : before;
    std::vector<BodyState> states = given;
    for (Body& body : bodies_) {
        BodyState& state = states[body.index];
        const BodyState& old = before_[body.index];
        const BodyState moved = body.solid.moved(old, dt_s);
        const Coupled& coupled = *setup_.bodies[body.index].coupled;
        if (coupled.moves) {
            state.centre_m = moved.centre_m;
            state.velocity_m_s = old.velocity_m_s;
        }
        if (coupled.turns) {
            state.orientation = moved.orientation;
            state.spin_rad_s = old.spin_rad_s;
        }
    }
    contacts_.separate(states, unknowns_);
    for (const Triple& triple : triples_) {
        const Body& body = bodies_[triple.body];
        const glm::dvec3 change = dt_s * triple.trust * triple.acceleration;
        if (triple.turns)
            states[body.index].spin_rad_s += change / setup_.cell_m;
        else
            states[body.index].velocity_m_s += change;
    }
    return states;
}

void Coupling::draw_potentials(const std::vector<BodyState>& states, const FaceFractions& a,
                               const std::vector<Box>& boxes, const std::vector<Displacement>& since) {
    std::vector<Box> touched = boxes;
    touched.insert(touched.end(), boxes_before_.begin(), boxes_before_.end());
    boxes_before_ = boxes;
    const Pressure::Work work{.cycles = kCycles + (cold_ ? kColdCycles : 0), .cut = boxes, .rough = boxes};
    cold_ = false;
    for (Triple& triple : triples_) {
        const std::size_t body = bodies_[triple.body].index;
        for (std::size_t axis = 0; axis < triple.potentials.size(); ++axis) {
            std::vector<BodyState> unit = states;
            for (BodyState& state : unit) state.velocity_m_s = state.spin_rad_s = glm::dvec3(0.0);
            glm::dvec3& velocity = triple.turns ? unit[body].spin_rad_s : unit[body].velocity_m_s;
            velocity[static_cast<glm::length_t>(axis)] = triple.turns ? 1.0 / setup_.cell_m : 1.0;
            uniforms_.set(unit);
            std::vector<Input> inputs = a.inputs();
            inputs.insert(inputs.end(), uniforms_.inputs().begin(), uniforms_.inputs().end());
            flux_.draw(inputs, uniforms_.uniforms(), {&b_.texture()}, Region::packed(touched));
            Field<Cells4>& phi = triple.potentials[axis];
            if (!since.empty()) phi = pressure_.follow(std::move(phi), {since[body]});
            phi = pressure_.solve(std::move(phi), b_, work);
        }
    }
}

Coupling::Sums Coupling::add_up(const std::vector<BodyState>& states, const Step& step) {
    const int width = width_of_loads(setup_);
    const auto draw = [&](Traction& traction, const Field<Cells4>& phi, std::size_t load,
                          const std::optional<Traction::Friction>& friction) {
        traction.draw(phi, step.a, uniforms_, states, step.boxes, *row_, friction,
                      width * static_cast<int>(load));
    };
    uniforms_.set(states);
    draw(rubbing_ ? *rubbing_ : pressing_, step.phi, kPressure, step.friction);
    if (hydrostatic_) draw(pressing_, *hydrostatic_, kHydrostatic, std::nullopt);
    for (std::size_t t = 0; t < triples_.size(); ++t)
        for (std::size_t axis = 0; axis < triples_[t].potentials.size(); ++axis)
            draw(pressing_, triples_[t].potentials[axis], kPotentials + 3 * t + axis, std::nullopt);
    readback_.request(*row_, 0);
    auto got = readback_.take(true);
    if (!got) throw GlError("the GPU has stopped answering; no forces came back for the free bodies");
    return {std::move(got->texels), setup_.bodies.size()};
}

Coupling::Unknown Coupling::unknown(std::size_t k) const {
    const Triple& triple = triples_[k / 3];
    const std::size_t axis = k % 3;
    return {triple.body, bodies_[triple.body].index, axis + (triple.turns ? 3 : 0),
            triple.turns ? 1.0 / setup_.cell_m : 1.0};
}

LinearSystem Coupling::newton(const std::vector<BodyState>& states, const Step& step, const Sums& sums) {
    const double h = setup_.cell_m, cell_mass = setup_.density_kg_m3 * h * h * h, dt = step.dt_s;
    LinearSystem system(3 * triples_.size()), resistance = system;
    double rate = 0.0;  // of a triple
    for (std::size_t k = 0; k < system.unknowns(); ++k) {
        const Unknown u = unknown(k);
        const Body& body = bodies_[u.body];
        const BodyState& guess = states[u.index];
        const Matrix6 mass = body.solid.mass_matrix(guess.orientation);
        const Vector6 before = body.solid.momentum(before_[u.index], guess.orientation);
        const Vector6 motion{guess.velocity_m_s.x, guess.velocity_m_s.y, guess.velocity_m_s.z,
                             guess.spin_rad_s.x,   guess.spin_rad_s.y,   guess.spin_rad_s.z};
        if (k % 3 == 0) rate = resistance_1_s(setup_, states, u.index, triples_[k / 3].turns, dt);
        double momentum = before[u.component];
        for (std::size_t c = 0; c < 6; ++c) momentum -= mass[u.component][c] * motion[c];
        // What the water that would be in its place weighs is what carries it at rest; exactly that, on this grid.
        const double weight = -body.density_ratio * dt * sums(kHydrostatic, u.index, u.component);
        system.b(k) = u.scale * momentum + cell_mass * (sums(kPressure, u.index, u.component) + weight);
        for (std::size_t l = 0; l < system.unknowns(); ++l) {
            const Unknown v = unknown(l);
            const double own = v.body == u.body ? u.scale * v.scale * mass[u.component][v.component] : 0.0;
            system.a(k, l) = own - cell_mass * sums(kPotentials + l, u.index, u.component);
            if (k / 3 == l / 3) resistance.a(k, l) = rate * own / body.density_ratio;
        }
    }
    for (std::size_t k = 0; k < system.unknowns(); ++k) {
        triples_[k / 3].trust[static_cast<glm::length_t>(k % 3)] =
            system.a(k, k) / (system.a(k, k) + dt * resistance.a(k, k));
        for (std::size_t l = 0; l < system.unknowns(); ++l) system.a(k, l) += dt * resistance.a(k, l);
    }
    return system;
}

void Coupling::solve(std::vector<BodyState>& states, const Step& step) {
    draw_potentials(states, step.a, step.boxes, step.since);
    const Sums sums = add_up(states, step);
    // guard coupled_sums: what is not a number moves nobody
    std::vector<double> change(3 * triples_.size(), 0.0);
    if (sums.are_finite())
        change = contacts_.solve(newton(states, step, sums), states, unknowns_, step.dt_s);
    else
        reset();  // whatever it is comes from what is kept from step to step
    const double fastest_m_s = fastest_body_m_s(setup_, step.dt_s);
    for (std::size_t t = 0; t < triples_.size(); ++t) {
        Triple& triple = triples_[t];
        const Body& body = bodies_[triple.body];
        BodyState& state = states[body.index];
        const BodyState& old = before_[body.index];
        glm::dvec3& own = triple.turns ? state.spin_rad_s : state.velocity_m_s;
        const double scale = triple.turns ? setup_.cell_m : 1.0;
        const glm::dvec3 guess = own;
        own += glm::dvec3(change[3 * t], change[3 * t + 1], change[3 * t + 2]) / scale;
        slow_down(state, setup_.bodies[body.index].shape, fastest_m_s);  // guard coupled_speed
        triple.change = scale * (own - guess);
        const glm::dvec3 gained = scale * (own - (triple.turns ? old.spin_rad_s : old.velocity_m_s));
        // What a wall or another body took is no sign of what comes next.
        triple.acceleration = contacts_.along(3 * t, gained) / step.dt_s;
    }
    uniforms_.set(states);
}

Field<Cells4> Coupling::add_to(Field<Cells4> phi) {
    for (const Triple& triple : triples_) {
        if (triple.potentials.empty()) continue;
        Field<Cells4> sum(gpu_, setup_.cells, Format::RGBA32F);
        add_.draw({{"phi", &phi.texture()},
                   {"phi_x", &triple.potentials[0].texture()},
                   {"phi_y", &triple.potentials[1].texture()},
                   {"phi_z", &triple.potentials[2].texture()}},
                  {{"v", glm::vec3(triple.change)}}, {&sum.texture()});
        phi = std::move(sum);
    }
    return phi;
}

}  // namespace eddy::gles
