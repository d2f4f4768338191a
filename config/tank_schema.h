#pragma once
#include "config/scene.h"

// The tank and what is in it, key by key (see scene_schema.h).

namespace eddy {

template <class Visitor>
void describe(Visitor& v, Scene::Wall& w) {
    v.value("kind", w.kind, "what it does to the fluid");
    v.value("velocity_m_s", w.velocity_m_s, "of the wall (no_slip) or of what comes in (inflow)");
}

template <class Visitor>
void describe(Visitor& v, Scene::Walls& w) {
    v.word_or_table("x_low", w.x_low, "left");
    v.word_or_table("x_high", w.x_high, "right");
    v.word_or_table("y_low", w.y_low, "floor");
    v.word_or_table("y_high", w.y_high, "lid");
    v.word_or_table("z_low", w.z_low, "back");
    v.word_or_table("z_high", w.z_high, "front, towards the visitor");
}

template <class Visitor>
void describe(Visitor& v, Scene::Tank& t) {
    v.value("size_m", t.size_m, "inner size along x (right), y (up), z (towards the visitor)",
            above(0, 1000));
    v.value("cells", t.cells,
            "how many cells it is divided into; size_m / cells must be the same along x, y and z",
            between(4, 512));
    v.template uniform<WallKind>("walls", t.walls, "What each wall does to the fluid.");
}

template <class Visitor>
void describe(Visitor& v, Scene::Fluid& f) {
    v.value("density_kg_m3", f.density_kg_m3, "air 1.2, water 1000; forces grow in proportion",
            above(0, 1e5));
    v.value("viscosity_pa_s", f.viscosity_pa_s,
            "dynamic: air 1.8e-5, water 0.001, glycerin 1.4; 0 is inviscid", between(0, 1e5));
    v.value("gravity_m_s2", f.gravity_m_s2, "on Earth [0, -9.81, 0]", between(-1e4, 1e4));
}

template <class Visitor>
void describe(Visitor& v, Scene::Temperature& t) {
    v.value("expansion_1_k", t.expansion_1_k,
            "how much lighter a kelvin makes the fluid, relative to density_kg_m3: air 0.0034, water 0.0002; "
            "needs gravity",
            between(-1, 1));
    v.value("diffusivity_m2_s", t.diffusivity_m2_s, "of heat: air 2.2e-5, water 1.4e-7", between(0, 1e3));
    v.value("initial_k", t.initial_k, "at the start, above the reference");
}

template <class Visitor>
void describe(Visitor& v, Scene::Smoke& s) {
    v.value("dissipation_1_s", s.dissipation_1_s,
            "rate at which smoke fades: it falls to 1/e in 1 / dissipation_1_s", between(0, 1e3));
    v.value("weight", s.weight,
            "how much heavier smoke of density 1 makes the fluid, relative to density_kg_m3; negative rises; "
            "needs gravity",
            between(-1e3, 1e3));
    v.value("initial", s.initial, "density at the start");
}

template <class Visitor>
void describe(Visitor& v, Scene::VorticityConfinement& c) {
    v.required(
        "strength_1_s", c.strength_1_s,
        "0 is off; vortices fed in proportion to it and to the width of a cell; more than a quarter in a "
        "step (0.25 / dt_s) counts as that",
        between(0, 1e3));
}

template <class Visitor>
void describe(Visitor& v, Scene::Source& s) {
    v.derived("name", s.name, "`source1`, `source2`, ...", "letters, digits, - and _; starts with a letter");
    v.required("centre_m", s.centre_m, "middle of the ball in which the source works");
    v.required("radius_m", s.radius_m, "radius of that ball", above(0, 1000));
    v.value("smoke_per_s", s.smoke_per_s, "how fast smoke thickens in the ball; needs [smoke]",
            between(0, 1e6));
    v.value("temperature_k_per_s", s.temperature_k_per_s,
            "how fast the ball heats up, or cools down if negative; needs [temperature]", between(-1e6, 1e6));
    v.value("velocity_m_s", s.velocity_m_s, "a jet: the fluid in the ball is driven to this velocity");
    v.value("start_s", s.start_s, "when it starts to work", at_least(0));
    v.value("stop_s", s.stop_s, "when it stops; never, if absent", above(0));
}

template <class Visitor>
void describe(Visitor& v, Scene::Initial& i) {
    v.value("velocity_m_s", i.velocity_m_s, "of all the fluid, at the start");
    v.value("velocity_npy", i.velocity_npy,
            "in place of velocity_m_s: a file as outputs.fields writes it; relative to the scene file");
}

template <class Visitor>
void describe(Visitor& v, Scene::Forcing& f) {
    v.required("acceleration_m_s2", f.acceleration_m_s2, "force on the fluid, for each kg of it");
}

template <class Visitor>
void describe(Visitor& v, Scene::Imposed& i) {
    v.required("velocity_m_s", i.velocity_m_s, "of the fluid, at all times");
}

}  // namespace eddy
