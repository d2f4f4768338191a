#include "firmware/effects/effect.h"

#include <algorithm>

namespace eddy::effects {
namespace {

template <class Member>
bool any_source_has(const Scene& scene, Member what) {
    return std::any_of(scene.sources.begin(), scene.sources.end(),
                       [&](const Scene::Source& source) { return (source.*what).has_value(); });
}

/// A source that gives nothing any more is none.
template <class Member>
void stop_sources(Scene& scene, Member what) {
    for (Scene::Source& source : scene.sources) (source.*what).reset();
    std::erase_if(scene.sources, [](const Scene::Source& source) {
        return !source.velocity_m_s && !source.smoke_per_s && !source.temperature_k_per_s;
    });
}

template <class Predicate>
bool any_body(const Scene& scene, Predicate predicate) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), predicate);
}

bool moved_by_the_fluid(const Scene::Body& body) {
    return body.motion == BodyMotion::Free || body.turning;
}

bool is_sticky(const Scene::Wall& wall) {
    return wall.kind == WallKind::NoSlip;
}

bool lets_through(const Scene::Wall& wall) {
    return wall.kind == WallKind::Inflow || wall.kind == WallKind::Open;
}

template <class Predicate>
bool any_wall(const Scene& scene, Predicate predicate) {
    const auto walls = scene.tank.walls.all();
    return std::any_of(walls.begin(), walls.end(), [&](const Scene::Wall* wall) { return predicate(*wall); });
}

template <class Predicate>
void make_slip(Scene& scene, Predicate predicate) {
    for (Scene::Wall* wall : scene.tank.walls.all())
        if (predicate(*wall)) *wall = {};
}

bool uses_maccormack(const Scene& scene) {
    const Scene::Solver& solver = scene.solver;
    return solver.advection ? *solver.advection == AdvectionScheme::MacCormack
                            : solver.preset == SolverPreset::Precise;
}

const Effect& find(std::string_view name) {
    const std::vector<Effect>& all = all_effects();
    return *std::find_if(all.begin(), all.end(), [&](const Effect& effect) { return effect.name == name; });
}

void add_with_needs(EffectNames& to, std::string_view name) {
    to.insert(name);
    for (const std::string_view needed : find(name).needs) add_with_needs(to, needed);
}

}  // namespace

const std::vector<Effect>& all_effects() {
    static const std::vector<Effect> all{
        {kBodies, {}, [](const Scene& s) { return !s.bodies.empty(); }, [](Scene& s) { s.bodies.clear(); }},
        {"force",
         {kBodies},
         [](const Scene& s) { return any_body(s, [](const Scene::Body& b) { return b.force; }); },
         [](Scene& s) {
             for (Scene::Body& body : s.bodies) body.force = false;
         }},
        {"torque",
         {kBodies},
         [](const Scene& s) { return any_body(s, [](const Scene::Body& b) { return b.torque; }); },
         [](Scene& s) {
             for (Scene::Body& body : s.bodies) body.torque = false;
         }},
        // Left out, a free body stays where it starts, and a turning one keeps its pose in the hand.
        {"free bodies",
         {kBodies},
         [](const Scene& s) { return any_body(s, moved_by_the_fluid); },
         [](Scene& s) {
             for (Scene::Body& body : s.bodies) {
                 if (body.motion == BodyMotion::Free) body.motion = BodyMotion::Fixed;
                 body.turning = false;
             }
         }},
        {"viscosity",
         {},
         [](const Scene& s) { return s.fluid.viscosity_pa_s != 0.0; },
         [](Scene& s) { s.fluid.viscosity_pa_s = 0.0; }},
        // Walls left out are slip walls: the least that keeps the fluid in.
        {"no-slip walls",
         {"viscosity"},
         [](const Scene& s) { return any_wall(s, is_sticky); },
         [](Scene& s) { make_slip(s, is_sticky); }},
        {"open walls",
         {},
         [](const Scene& s) { return any_wall(s, lets_through); },
         [](Scene& s) { make_slip(s, lets_through); }},
        {"gravity",
         {},
         [](const Scene& s) { return s.fluid.gravity_m_s2 != glm::dvec3(0.0); },
         [](Scene& s) { s.fluid.gravity_m_s2 = glm::dvec3(0.0); }},
        {"forcing",
         {},
         [](const Scene& s) { return s.forcing.has_value(); },
         [](Scene& s) { s.forcing.reset(); }},
        {"confinement",
         {},
         [](const Scene& s) {
             return s.vorticity_confinement && s.vorticity_confinement->strength_1_s != 0.0;
         },
         [](Scene& s) { s.vorticity_confinement.reset(); }},
        {"jets",
         {},
         [](const Scene& s) { return any_source_has(s, &Scene::Source::velocity_m_s); },
         [](Scene& s) { stop_sources(s, &Scene::Source::velocity_m_s); }},
        {"smoke", {}, [](const Scene& s) { return s.smoke.has_value(); }, [](Scene& s) { s.smoke.reset(); }},
        {"smoke sources",
         {"smoke"},
         [](const Scene& s) { return any_source_has(s, &Scene::Source::smoke_per_s); },
         [](Scene& s) { stop_sources(s, &Scene::Source::smoke_per_s); }},
        {"smoke fading",
         {"smoke"},
         [](const Scene& s) { return s.smoke && s.smoke->dissipation_1_s != 0.0; },
         [](Scene& s) {
             if (s.smoke) s.smoke->dissipation_1_s = 0.0;
         }},
        {"smoke weight",
         {"smoke", "gravity"},
         [](const Scene& s) { return s.smoke && s.smoke->weight != 0.0; },
         [](Scene& s) {
             if (s.smoke) s.smoke->weight = 0.0;
         }},
        {"heat",
         {},
         [](const Scene& s) { return s.temperature.has_value(); },
         [](Scene& s) { s.temperature.reset(); }},
        {"heat sources",
         {"heat"},
         [](const Scene& s) { return any_source_has(s, &Scene::Source::temperature_k_per_s); },
         [](Scene& s) { stop_sources(s, &Scene::Source::temperature_k_per_s); }},
        {"heat diffusion",
         {"heat"},
         [](const Scene& s) { return s.temperature && s.temperature->diffusivity_m2_s != 0.0; },
         [](Scene& s) {
             if (s.temperature) s.temperature->diffusivity_m2_s = 0.0;
         }},
        {"heat lift",
         {"heat", "gravity"},
         [](const Scene& s) { return s.temperature && s.temperature->expansion_1_k != 0.0; },
         [](Scene& s) {
             if (s.temperature) s.temperature->expansion_1_k = 0.0;
         }},
        {"maccormack",
         {},
         uses_maccormack,
         [](Scene& s) { s.solver.advection = AdvectionScheme::SemiLagrangian; }},
        {"second order in time",
         {},
         [](const Scene& s) { return s.solver.time_order == 2; },
         [](Scene& s) { s.solver.time_order = 1; }},
    };
    return all;
}

EffectNames effects_of(const Scene& scene) {
    EffectNames names;
    for (const Effect& effect : all_effects())
        if (effect.is_in(scene)) names.insert(effect.name);
    return names;
}

EffectNames with_needs(const EffectNames& effects) {
    EffectNames all;
    for (const std::string_view name : effects) add_with_needs(all, name);
    return all;
}

EffectNames without(const EffectNames& effects, std::string_view one) {
    EffectNames left;
    for (const std::string_view name : effects)
        if (!with_needs({name}).contains(one)) left.insert(name);
    return left;
}

Scene with_only(Scene scene, const EffectNames& effects) {
    for (const Effect& effect : all_effects())
        if (!effects.contains(effect.name) && effect.is_in(scene)) effect.leave_out(scene);
    return scene;
}

}  // namespace eddy::effects
