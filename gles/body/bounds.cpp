#include "gles/body/bounds.h"

#include <algorithm>
#include <cmath>

#include "gles/body/distance_grid.h"

namespace eddy::gles {
namespace {

/// Cells around a body whose fluid fractions, or the differences of them, it can change.
constexpr double kMargin = 2.0;

struct RadiusOf {
    double operator()(const Sphere& s) const { return s.radius_m; }
    double operator()(const Cuboid& s) const { return 0.5 * glm::length(s.size_m); }
    double operator()(const Capsule& s) const { return s.radius_m + 0.5 * s.length_m; }
    double operator()(const Cylinder& s) const { return std::hypot(s.radius_m, 0.5 * s.length_m); }
    double operator()(const Torus& s) const { return s.radius_m + s.tube_radius_m; }
    double operator()(const Ellipsoid& s) const { return std::max({s.radii_m.x, s.radii_m.y, s.radii_m.z}); }
    double operator()(const Paddle& s) const {
        return std::max(0.5 * glm::length(s.blade_m),
                        std::hypot(s.handle_radius_m, 0.5 * s.blade_m.y + s.handle_length_m));
    }
    double operator()(const Tetrahedron& s) const { return glm::length(corners_m(s)[0]); }
    double operator()(const Mesh& s) const { return s.distance->radius_m(); }
};

struct ThicknessOf {
    static double least(const glm::dvec3& v) { return std::min({v.x, v.y, v.z}); }
    double operator()(const Sphere& s) const { return 2.0 * s.radius_m; }
    double operator()(const Cuboid& s) const { return least(s.size_m); }
    double operator()(const Capsule& s) const { return 2.0 * s.radius_m; }
    double operator()(const Cylinder& s) const { return std::min(2.0 * s.radius_m, s.length_m); }
    double operator()(const Torus& s) const { return 2.0 * s.tube_radius_m; }
    double operator()(const Ellipsoid& s) const { return 2.0 * least(s.radii_m); }
    double operator()(const Paddle& s) const { return std::min(least(s.blade_m), 2.0 * s.handle_radius_m); }
    double operator()(const Tetrahedron& s) const { return std::sqrt(2.0 / 3.0) * s.edge_m; }  // its height
    double operator()(const Mesh&) const { return 0.0; }
};

/// Half the extent of a disk whose axis is `axis`.
glm::dvec3 disk(const glm::dvec3& axis, double radius) {
    return radius * glm::sqrt(glm::max(1.0 - axis * axis, 0.0));
}

Extent about(const glm::dvec3& middle, const glm::dvec3& half) {
    return {middle - half, middle + half};
}

struct ExtentOf {
    glm::dmat3 axes;  ///< of the body

    /// Half the extent of a box.
    glm::dvec3 box(const glm::dvec3& half) const {
        return glm::abs(axes[0]) * half.x + glm::abs(axes[1]) * half.y + glm::abs(axes[2]) * half.z;
    }
    glm::dvec3 cylinder(double radius, double length) const {
        return disk(axes[1], radius) + 0.5 * length * glm::abs(axes[1]);
    }

    Extent operator()(const Sphere& s) const { return about(glm::dvec3(0.0), glm::dvec3(s.radius_m)); }
    Extent operator()(const Cuboid& s) const { return about(glm::dvec3(0.0), box(0.5 * s.size_m)); }
    Extent operator()(const Capsule& s) const {
        return about(glm::dvec3(0.0), s.radius_m + 0.5 * s.length_m * glm::abs(axes[1]));
    }
    Extent operator()(const Cylinder& s) const {
        return about(glm::dvec3(0.0), cylinder(s.radius_m, s.length_m));
    }
    Extent operator()(const Torus& s) const {
        return about(glm::dvec3(0.0), disk(axes[1], s.radius_m) + s.tube_radius_m);
    }
    Extent operator()(const Ellipsoid& s) const {
        const glm::dvec3 x = axes[0] * s.radii_m.x, y = axes[1] * s.radii_m.y, z = axes[2] * s.radii_m.z;
        return about(glm::dvec3(0.0), glm::sqrt(x * x + y * y + z * z));
    }
    Extent operator()(const Paddle& s) const {
        const double length = 0.5 * s.blade_m.y + s.handle_length_m;
        const Extent blade = about(glm::dvec3(0.0), box(0.5 * s.blade_m));
        const Extent handle = about(0.5 * length * axes[1], cylinder(s.handle_radius_m, length));
        return {glm::min(blade.low, handle.low), glm::max(blade.high, handle.high)};
    }
    Extent operator()(const Tetrahedron& s) const {
        Extent e{glm::dvec3(0.0), glm::dvec3(0.0)};
        for (const glm::dvec3& corner : corners_m(s)) {
            const glm::dvec3 x = axes * corner;
            e = {glm::min(e.low, x), glm::max(e.high, x)};
        }
        return e;
    }
    Extent operator()(const Mesh& s) const {
        const glm::dvec3 low = s.distance->mesh_low_m(), high = s.distance->mesh_high_m();
        return about(axes * (0.5 * (low + high)), box(0.5 * (high - low)));
    }
};

}  // namespace

std::array<glm::dvec3, 4> corners_m(const Tetrahedron& tetrahedron) {
    const double edge = tetrahedron.edge_m;
    const double floor = -edge * std::sqrt(1.0 / 24.0), behind = -edge * std::sqrt(1.0 / 12.0);
    return {{{0.0, edge * std::sqrt(3.0 / 8.0), 0.0},
             {0.0, floor, edge * std::sqrt(1.0 / 3.0)},
             {0.5 * edge, floor, behind},
             {-0.5 * edge, floor, behind}}};
}

double bounding_radius_m(const Shape& shape) {
    return std::visit(RadiusOf{}, shape);
}

Ball bounding_ball(const Shape& shape) {
    const Mesh* mesh = std::get_if<Mesh>(&shape);
    if (!mesh) return {glm::dvec3(0.0), bounding_radius_m(shape)};
    const glm::dvec3 low = mesh->distance->mesh_low_m(), high = mesh->distance->mesh_high_m();
    return {0.5 * (low + high), 0.5 * glm::length(high - low)};
}

glm::dvec3 middle_m(const Shape& shape, const BodyState& state) {
    return state.centre_m + state.orientation * bounding_ball(shape).centre_m;
}

double thickness_m(const Shape& shape) {
    return std::visit(ThicknessOf{}, shape);
}

Extent extent(const Shape& shape, const glm::dquat& orientation) {
    return std::visit(ExtentOf{glm::mat3_cast(glm::normalize(orientation))}, shape);
}

Extent room_for_centre(const Extent& body, const glm::dvec3& size_m, double gap_m) {
    const glm::dvec3 low = gap_m - body.low, high = size_m - (gap_m + body.high);
    const glm::dvec3 middle = 0.5 * (size_m - (body.low + body.high));
    return {glm::min(low, middle), glm::max(high, middle)};
}

Box body_box(const BodySetup& body, const BodyState& state, double cell_m, const glm::ivec3& cells) {
    if (body.inside_out) return {glm::ivec3(0), cells};
    const Extent e = extent(body.shape, state.orientation);
    const glm::dvec3 centre = state.centre_m / cell_m;
    const Box box{glm::ivec3(glm::floor(centre + e.low / cell_m - kMargin)),
                  glm::ivec3(glm::ceil(centre + e.high / cell_m + kMargin))};
    return box.intersect({glm::ivec3(0), cells});
}

glm::ivec3 largest_body_box(const BodySetup& body, double cell_m, const glm::ivec3& cells) {
    if (body.inside_out) return cells;
    // Of a mesh, extent() turns the box that holds it. A position within a cell can add one.
    const double edge = 2.0 * (bounding_ball(body.shape).radius_m / cell_m + kMargin);
    return glm::min(glm::ivec3(static_cast<int>(std::ceil(edge)) + 1), cells);
}

}  // namespace eddy::gles
