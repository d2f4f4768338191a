#pragma once
#include "config/body_schema.h"
#include "config/scene.h"
#include "config/tank_schema.h"

// The scene file, described once: each key with its meaning and range. The defaults are in scene.h. Every
// visitor (Reader, Printer, Reference) walks these functions.

namespace eddy {

template <class Visitor>
void describe(Visitor& v, Scene::Solver& s) {
    v.value("preset", s.preset, "which solver");
    v.value("dt_s", s.dt_s, "time step", above(0, 1));
    v.value("advection", s.advection, "in place of the preset's; not for yang2009");
    v.value("cycles", s.cycles, "multigrid cycles a step, in place of the preset's; not for yang2009",
            between(1, 20));
    v.value("viscous_cycles", s.viscous_cycles,
            "multigrid cycles a step for the viscous term, in place of the preset's; not for yang2009",
            between(1, 20));
    v.value("time_order", s.time_order,
            "accuracy of the splitting in time: first or second order; yang2009 has 1", between(1, 2));
    v.value("jacobi_sweeps", s.jacobi_sweeps,
            "pressure sweeps a step, in place of the preset's; only for yang2009", between(1, 400));
    v.value("force_sum", s.force_sum, "where the force is added up, in place of the GPU; only for yang2009");
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
void describe(Visitor& v, Scene::Probe& p) {
    v.derived("name", p.name, "`probe1`, `probe2`, ...", "letters, digits, - and _; starts with a letter");
    v.required("quantity", p.quantity, "what it measures");
    v.value("point_m", p.point_m, "where");
    v.value("from_m", p.from_m, "in place of point_m: the first of several points on a line ...");
    v.value("to_m", p.to_m, "... the last one ...");
    v.value("points", p.points, "... and how many they are, at equal distances", between(2, 1000));
}

template <class Visitor>
void describe(Visitor& v, Scene::Outputs& o) {
    v.value("duration_s", o.duration_s, "how long to simulate", above(0, 1e6));
    v.value("series", o.series, "write series.csv: forces and sums at each step");
    v.value(
        "force_methods", o.force_methods,
        "measure the forces in two more ways: by the balance of momentum in a box around each body (columns "
        "force_box_...), and by the impulse that the body gives to the fluid (force_impulse_...); "
        "transport_... is "
        "what transport makes or loses in the box; slower");
    v.value("fields", o.fields, "whole fields to write at the end, as .npy");
}

template <class Visitor>
void describe(Visitor& v, Scene& s) {
    v.value("title", s.title, "one line, for the screen and the reports");
    v.value("description", s.description, "what one sees and feels");
    v.table("tank", s.tank, "The box of fluid.");
    v.table("fluid", s.fluid, "What is in the tank.");
    v.table("temperature", s.temperature, "Effect: heat, carried by the flow.");
    v.table("smoke", s.smoke, "Effect: smoke, carried by the flow.");
    v.table("vorticity_confinement", s.vorticity_confinement,
            "Effect: small vortices that the grid has blurred are fed (Steinhoff and Underhill 1994).");
    v.list("source", s.sources, "A ball of the tank where smoke, heat or a jet comes from.");
    v.list("body", s.bodies, "A solid in the fluid.");
    v.table("initial", s.initial, "The flow at the start.");
    v.table("forcing", s.forcing, "Effect: a force on all the fluid.");
    v.table("imposed", s.imposed, "Effect: the flow is given, not computed; smoke and heat follow it.");
    v.table("solver", s.solver, "How the flow is computed.");
    v.table("haptics", s.haptics, "How the hand is coupled to the held body.");
    v.table("render", s.render, "The picture.");
    v.list("probe", s.probes,
           "A quantity at a point, or along a line, as columns of series.csv: `wake_velocity_x_m_s`, "
           "`wake_pressure_pa`, "
           "`wake_smoke`, `wake_temperature_k` for a probe named `wake`; along a line `wake_1_...`, "
           "`wake_2_...`.");
    v.table("outputs", s.outputs, "What a simulation writes.");
}

}  // namespace eddy
