#pragma once
#include <string>
#include <string_view>

#include "config/scene_words.h"

namespace eddy {

/// A key that says how large a body is, and the shapes that have it.
struct SizeKey {
    std::string_view key;
    std::string_view holds;
    unsigned shapes;  // a bit each
    bool optional = false;
};

template <class... Shapes>
constexpr unsigned shape_set(Shapes... shapes) {
    return ((1u << static_cast<unsigned>(shapes)) | ...);
}

inline constexpr SizeKey kSizeKeys[] = {
    {"radius_m", "a number",
     shape_set(BodyShape::Sphere, BodyShape::Capsule, BodyShape::Cylinder, BodyShape::Torus,
               BodyShape::Disk)},
    {"size_m", "a list of 3 numbers", shape_set(BodyShape::Box)},
    {"length_m", "a number", shape_set(BodyShape::Capsule, BodyShape::Cylinder)},
    {"tube_radius_m", "a number", shape_set(BodyShape::Torus)},
    {"radii_m", "a list of 3 numbers", shape_set(BodyShape::Ellipsoid)},
    {"thickness_m", "a number", shape_set(BodyShape::Disk)},
    {"blade_m", "a list of 3 numbers", shape_set(BodyShape::Paddle)},
    {"handle_radius_m", "a number", shape_set(BodyShape::Paddle)},
    {"handle_length_m", "a number", shape_set(BodyShape::Paddle)},
    {"edge_m", "a number", shape_set(BodyShape::Tetrahedron)},
    {"file", "a file name", shape_set(BodyShape::Mesh)},
    {"scale", "a number", shape_set(BodyShape::Mesh), true},
};

constexpr bool belongs_to(const SizeKey& size, BodyShape shape) {
    return (size.shapes & shape_set(shape)) != 0;
}

/// Whether bodies of this shape have the size key.
bool has_size(BodyShape shape, std::string_view key);

/// "radius_m, length_m"
std::string sizes_of(BodyShape shape);

/// "must be given for `capsule`, `cylinder`", for the reference.
std::string shapes_with(std::string_view key);

}  // namespace eddy
