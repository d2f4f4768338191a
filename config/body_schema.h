#pragma once
#include "config/body_sizes.h"
#include "config/scene.h"

// The bodies, key by key (see scene_schema.h).

namespace eddy {

template <class Visitor>
void describe(Visitor& v, Scene::Oscillation& o) {
    v.value("amplitude_m", o.amplitude_m, "the body swings this far to either side of its path");
    v.required("frequency_hz", o.frequency_hz, "swings in a second", above(0, 1e4));
    v.value("phase_rad", o.phase_rad, "0 starts in the middle, at full speed");
    v.value("axis", o.axis, "it turns about this direction through its centre", between(-1e3, 1e3));
    v.value("angle_deg", o.angle_deg, "it turns this far to either side", between(-3600, 3600));
}

template <class Visitor>
void describe(Visitor& v, Scene::Body& b) {
    v.derived("name", b.name, "`body1`, `body2`, ...", "letters, digits, - and _; starts with a letter");
    v.value("shape", b.shape, "what it looks like; its own axes are the tank's before it is turned");
    const auto size = [&](std::string_view key, auto& field, std::string_view doc, const Range& range) {
        v.conditional(key, field, has_size(b.shape, key), shapes_with(key), doc, range);
    };
    size("radius_m", b.radius_m, "of a torus: of the middle line of the ring", above(0, 1000));
    size("size_m", b.size_m, "edges", above(0, 1000));
    size("length_m", b.length_m, "of a capsule: without the round ends", above(0, 1000));
    size("tube_radius_m", b.tube_radius_m, "half the thickness of the ring", above(0, 1000));
    size("radii_m", b.radii_m, "half axes", above(0, 1000));
    size("thickness_m", b.thickness_m, "along y", above(0, 1000));
    size("blade_m", b.blade_m, "edges of the blade", above(0, 1000));
    size("handle_radius_m", b.handle_radius_m, "of the handle", above(0, 1000));
    size("handle_length_m", b.handle_length_m, "of the handle, from the upper edge of the blade",
         above(0, 1000));
    size("edge_m", b.edge_m, "each of its six edges", above(0, 1000));
    size("file", b.file, "STL or OBJ, its origin at centre_m; relative to the scene file", {});
    v.conditional("scale", b.scale, has_size(b.shape, "scale"), "`1`; only for `mesh`",
                  "metres for a unit of the file", above(0, 1e6));
    v.value("inside_out", b.inside_out, "solid outside the shape and fluid inside: a container");
    v.derived("centre_m", b.centre_m, "held: centre_m of [haptics]; else must be given",
              "where it starts; for a held body, where it waits for the hand");
    v.value("axis", b.axis, "it is turned about this direction ...", between(-1e3, 1e3));
    v.value("angle_deg", b.angle_deg, "... by this much, at the start", between(-3600, 3600));
    v.value("motion", b.motion, "who moves it");
    v.value("density_kg_m3", b.density_kg_m3,
            "of a free body, which needs it, and of a turning one, which else has the fluid's: the same all "
            "through it",
            above(0, 1e5));
    v.value("turning", b.turning, "held only: torque turns it in the hand, about centre_m");
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

}  // namespace eddy
