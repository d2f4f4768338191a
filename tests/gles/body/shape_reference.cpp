#include "tests/gles/body/shape_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "gles/body/bounds.h"

namespace eddy::gles {
namespace {

double to_segment(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double t = glm::clamp(glm::dot(x - a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(x - a - t * along);
}

double to_triangle(const glm::dvec3& x, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    const auto left_of = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(glm::cross(q - p, x - p), n) >= 0.0;
    };
    if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return std::abs(glm::dot(x - a, n));
    return std::min({to_segment(x, a, b), to_segment(x, b, c), to_segment(x, c, a)});
}

/// A surface of revolution about y, by its profile: straight pieces and arcs in (distance from y, y).
class Profile {
  public:
    explicit Profile(const glm::dvec3& x) : at_(std::hypot(x.x, x.z), x.y, 0.0) {}
    Profile& line(double r0, double y0, double r1, double y1) {
        nearest_ = std::min(nearest_, to_segment(at_, {r0, y0, 0.0}, {r1, y1, 0.0}));
        return *this;
    }
    Profile& arc(double r, double y, double radius, double from, double to) {
        constexpr int kPieces = 3000;
        const auto place = [&](int i) {
            const double angle = from + (to - from) * i / kPieces;
            return glm::dvec2(r + radius * std::cos(angle), y + radius * std::sin(angle));
        };
        for (int i = 0; i < kPieces; ++i) line(place(i).x, place(i).y, place(i + 1).x, place(i + 1).y);
        return *this;
    }
    double distance() const { return nearest_; }

  private:
    glm::dvec3 at_;
    double nearest_ = 1e300;
};

constexpr double kQuarter = std::numbers::pi / 2.0;

double cylinder_surface(const glm::dvec3& x, double radius, double low, double high) {
    return Profile(x)
        .line(0.0, low, radius, low)
        .line(radius, low, radius, high)
        .line(radius, high, 0.0, high)
        .distance();
}

/// Distance to the surface, without a sign.
struct ToSurface {
    glm::dvec3 x;

    double operator()(const Sphere& s) const {
        return Profile(x).arc(0.0, 0.0, s.radius_m, -kQuarter, kQuarter).distance();
    }
    double operator()(const Cuboid& s) const {
        const glm::dvec3 h = 0.5 * s.size_m;
        double nearest = 1e300;
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                const auto corner = [&](double u, double v) {
                    glm::dvec3 c;
                    c[axis] = side * h[axis];
                    c[(axis + 1) % 3] = u * h[(axis + 1) % 3];
                    c[(axis + 2) % 3] = v * h[(axis + 2) % 3];
                    return c;
                };
                nearest = std::min({nearest, to_triangle(x, corner(-1, -1), corner(1, -1), corner(1, 1)),
                                    to_triangle(x, corner(-1, -1), corner(1, 1), corner(-1, 1))});
            }
        return nearest;
    }
    double operator()(const Capsule& s) const {
        const double r = s.radius_m, h = 0.5 * s.length_m;
        return Profile(x).line(r, -h, r, h).arc(0, h, r, 0, kQuarter).arc(0, -h, r, -kQuarter, 0).distance();
    }
    double operator()(const Cylinder& s) const {
        return cylinder_surface(x, s.radius_m, -0.5 * s.length_m, 0.5 * s.length_m);
    }
    double operator()(const Torus& s) const {
        return Profile(x).arc(s.radius_m, 0.0, s.tube_radius_m, 0.0, 4.0 * kQuarter).distance();
    }
    // The nearest point is q = r^2 x / (r^2 + t) where sum (q / r)^2 = 1 (Eberly 2013, "Distance from a point
    // to an ellipse, an ellipsoid, or a hyperellipsoid"). Not for x on a plane of symmetry.
    double operator()(const Ellipsoid& s) const {
        const glm::dvec3 r2 = s.radii_m * s.radii_m;
        const auto nearest = [&](double t) { return r2 * x / (r2 + t); };
        double low = -std::min({r2.x, r2.y, r2.z}), high = glm::length(x) * 100.0;
        for (int i = 0; i < 200; ++i) {
            const double t = 0.5 * (low + high);
            const glm::dvec3 q = nearest(t) / s.radii_m;
            (glm::dot(q, q) > 1.0 ? low : high) = t;
        }
        return glm::length(x - nearest(high));
    }
    /// Right outside; inside, the distance to the nearer surface of the two.
    double operator()(const Paddle& s) const {
        const double length = 0.5 * s.blade_m.y + s.handle_length_m;
        return std::min((*this)(Cuboid{s.blade_m}), cylinder_surface(x, s.handle_radius_m, 0.0, length));
    }
    double operator()(const Tetrahedron& s) const {
        const auto c = corners_m(s);
        return std::min({to_triangle(x, c[0], c[1], c[2]), to_triangle(x, c[0], c[2], c[3]),
                         to_triangle(x, c[0], c[3], c[1]), to_triangle(x, c[1], c[2], c[3])});
    }
    double operator()(const Mesh&) const { return 0.0; }
};

struct Inside {
    glm::dvec3 x;

    bool operator()(const Sphere& s) const { return glm::length(x) < s.radius_m; }
    bool operator()(const Cuboid& s) const { return glm::all(glm::lessThan(glm::abs(x), 0.5 * s.size_m)); }
    bool operator()(const Capsule& s) const {
        const glm::dvec3 end(0.0, 0.5 * s.length_m, 0.0);
        return to_segment(x, -end, end) < s.radius_m;
    }
    bool operator()(const Cylinder& s) const {
        return std::hypot(x.x, x.z) < s.radius_m && std::abs(x.y) < 0.5 * s.length_m;
    }
    bool operator()(const Torus& s) const {
        const glm::dvec3 ring = s.radius_m * glm::normalize(glm::dvec3(x.x, 0.0, x.z));
        return glm::length(x - ring) < s.tube_radius_m;
    }
    bool operator()(const Ellipsoid& s) const { return glm::length(x / s.radii_m) < 1.0; }
    bool operator()(const Paddle& s) const {
        const bool in_handle = std::hypot(x.x, x.z) < s.handle_radius_m && x.y > 0.0 &&
                               x.y < 0.5 * s.blade_m.y + s.handle_length_m;
        return in_handle || (*this)(Cuboid{s.blade_m});
    }
    bool operator()(const Tetrahedron& s) const {
        const auto c = corners_m(s);
        // On the same side of each face as the corner across, which lies at minus three times its middle.
        for (const glm::dvec3& corner : c)
            if (glm::dot(x, corner) < -glm::dot(corner, corner) / 3.0) return false;
        return true;
    }
    bool operator()(const Mesh&) const { return false; }
};

}  // namespace

bool is_inside(const Shape& shape, const glm::dvec3& x) {
    return std::visit(Inside{x}, shape);
}

double exact_distance(const Shape& shape, const glm::dvec3& x) {
    const double d = std::visit(ToSurface{x}, shape);
    return is_inside(shape, x) ? -d : d;
}

std::vector<NamedShape> closed_form_shapes() {
    return {{"sphere", Sphere{3.0}},
            {"cuboid", Cuboid{{4.0, 7.0, 2.5}}},
            {"capsule", Capsule{1.8, 4.5}},
            {"cylinder", Cylinder{2.5, 5.0}},
            {"disk", Cylinder{4.0, 1.6}},
            {"torus", Torus{4.0, 1.3}},
            {"ellipsoid", Ellipsoid{{4.5, 2.5, 3.5}}},
            {"paddle", Paddle{{5.0, 5.0, 1.8}, 1.2, 3.0}},
            {"tetrahedron", Tetrahedron{7.0}}};
}

glm::dvec3 random_point(Random& random, double low, double high) {
    std::uniform_real_distribution<double> coordinate(low, high);
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return {x, y, z};
}

glm::dquat random_turn(Random& random) {
    std::normal_distribution<double> normal;
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    return glm::normalize(glm::dquat(w, x, y, z));
}

}  // namespace eddy::gles
