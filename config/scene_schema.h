#pragma once
#include "config/scene.h"

// The scene file, described once: each key with its meaning and range. The defaults are in scene.h. Every
// visitor (Reader, Printer, Reference) walks these functions.

namespace eddy {

template <class Visitor>
void describe(Visitor& v, Scene::Walls& w) {
    v.value("x_low", w.x_low, "left");
    v.value("x_high", w.x_high, "right");
    v.value("y_low", w.y_low, "floor");
    v.value("y_high", w.y_high, "lid");
    v.value("z_low", w.z_low, "back");
    v.value("z_high", w.z_high, "front, towards the visitor");
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
}

template <class Visitor>
void describe(Visitor& v, Scene::Smoke& s) {
    v.value("dissipation_1_s", s.dissipation_1_s,
            "rate at which smoke fades: it falls to 1/e in 1 / dissipation_1_s", between(0, 1e3));
}

template <class Visitor>
void describe(Visitor& v, Scene::Source& s) {
    v.derived("name", s.name, "`source1`, `source2`, ...", "letters, digits, - and _; starts with a letter");
    v.required("centre_m", s.centre_m, "middle of the ball in which the source works");
    v.required("radius_m", s.radius_m, "radius of that ball", above(0, 1000));
    v.value("smoke_per_s", s.smoke_per_s, "how fast smoke thickens in the ball; needs [smoke]",
            between(0, 1e6));
    v.value("velocity_m_s", s.velocity_m_s, "a jet: the fluid in the ball is driven to this velocity");
    v.value("start_s", s.start_s, "when it starts to work", at_least(0));
    v.value("stop_s", s.stop_s, "when it stops; never, if absent", above(0));
}

template <class Visitor>
void describe(Visitor& v, Scene::Oscillation& o) {
    v.required("amplitude_m", o.amplitude_m, "the body swings this far to either side of its path");
    v.required("frequency_hz", o.frequency_hz, "swings in a second", above(0, 1e4));
    v.value("phase_rad", o.phase_rad, "0 starts in the middle, at full speed");
}

template <class Visitor>
void describe(Visitor& v, Scene::Body& b) {
    v.derived("name", b.name, "`body1`, `body2`, ...", "letters, digits, - and _; starts with a letter");
    v.value("shape", b.shape, "what it looks like");
    v.required("radius_m", b.radius_m, "radius of the sphere", above(0, 1000));
    v.derived("centre_m", b.centre_m, "held: centre_m of [haptics]; else must be given",
              "where it starts; for a held body, where it waits for the hand");
    v.value("motion", b.motion, "who moves it");
    v.value("velocity_m_s", b.velocity_m_s, "prescribed only: steady part of its velocity");
    v.value("acceleration_m_s2", b.acceleration_m_s2, "prescribed only: steady acceleration");
    v.value("spin_rad_s", b.spin_rad_s, "prescribed only: angular velocity about its centre");
    v.value("path_csv", b.path_csv,
            "prescribed only: a file of displacements from centre_m, added to the rest; relative to the "
            "scene file");
    v.value("start_s", b.start_s, "prescribed only: it rests until then, and its time counts from then",
            at_least(0));
    v.value("force", b.force, "measure the force on it");
    v.value("torque", b.torque, "measure the torque on it, about its centre");
    v.table("oscillation", b.oscillation, "Prescribed only: a swing, added to the rest.");
}

template <class Visitor>
void describe(Visitor& v, Scene::Initial& i) {
    v.value("velocity_m_s", i.velocity_m_s, "of all the fluid, at the start");
}

template <class Visitor>
void describe(Visitor& v, Scene::Solver& s) {
    v.value("preset", s.preset, "which solver");
    v.value("dt_s", s.dt_s, "time step", above(0, 1));
    v.value("advection", s.advection, "in place of the preset's");
    v.value("cycles", s.cycles, "multigrid cycles a step, in place of the preset's; not for yang2009",
            between(1, 20));
    v.value("jacobi_sweeps", s.jacobi_sweeps,
            "pressure sweeps a step, in place of the preset's; only for yang2009", between(1, 400));
}

template <class Visitor>
void describe(Visitor& v, Scene::Haptics& h) {
    v.value("gain", h.gain, "force on the hand = gain x force of the fluid on the held body",
            between(0, 1e9));
    v.value("max_force_n", h.max_force_n, "the hand never feels more", between(0, 8));
    v.value("workspace_scale", h.workspace_scale, "tank metres for a metre of the hand", above(0, 1e4));
    v.derived("centre_m", h.centre_m, "the middle of the tank",
              "point of the tank under the middle of the handle's reach");
}

template <class Visitor>
void describe(Visitor& v, Scene::Render& r) {
    v.value("width_px", r.width_px, "picture width", between(16, 7680));
    v.value("height_px", r.height_px, "picture height", between(16, 7680));
    v.value("azimuth_deg", r.azimuth_deg, "camera: 0 in front of the tank, 90 on its right",
            between(-360, 360));
    v.value("elevation_deg", r.elevation_deg, "camera: 0 level with the tank, 90 above it", between(-90, 90));
    v.value("distance_factor", r.distance_factor,
            "camera: distance from the middle of the tank, in tank diagonals", above(0, 100));
    v.value("smoke_colour", r.smoke_colour, "red, green, blue", between(0, 1));
    v.value("background_colour", r.background_colour, "red, green, blue", between(0, 1));
    v.value("exposure", r.exposure, "brightness of the whole picture", above(0, 1e3));
    v.value("extinction_1_m", r.extinction_1_m,
            "how opaque smoke of density 1 is: light falls to 1/e in 1 / extinction_1_m", between(0, 1e6));
}

template <class Visitor>
void describe(Visitor& v, Scene::Outputs& o) {
    v.value("duration_s", o.duration_s, "how long to simulate", above(0, 1e6));
    v.value("series", o.series, "write series.csv: forces and sums at each step");
    v.value("fields", o.fields, "whole fields to write at the end, as .npy");
}

template <class Visitor>
void describe(Visitor& v, Scene& s) {
    v.value("title", s.title, "one line, for the screen and the reports");
    v.value("description", s.description, "what one sees and feels");
    v.table("tank", s.tank, "The box of fluid.");
    v.table("fluid", s.fluid, "What is in the tank.");
    v.table("smoke", s.smoke, "Effect: smoke, carried by the flow.");
    v.list("source", s.sources, "A ball of the tank where smoke or a jet comes from.");
    v.list("body", s.bodies, "A solid in the fluid.");
    v.table("initial", s.initial, "The flow at the start.");
    v.table("solver", s.solver, "How the flow is computed.");
    v.table("haptics", s.haptics, "How the hand is coupled to the held body.");
    v.table("render", s.render, "The picture.");
    v.table("outputs", s.outputs, "What a simulation writes.");
}

}  // namespace eddy
