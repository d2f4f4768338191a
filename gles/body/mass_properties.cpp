#include "gles/body/mass_properties.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gles/body/distance_grid.h"

namespace eddy::gles {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dmat3 diagonal(const glm::dvec3& d) {
    return {glm::dvec3(d.x, 0.0, 0.0), glm::dvec3(0.0, d.y, 0.0), glm::dvec3(0.0, 0.0, d.z)};
}

/// A solid whose centre is the origin, from the means of x^2, y^2 and z^2 in it.
Moments centred(double volume, const glm::dvec3& mean_squares) {
    return {volume, glm::dvec3(0.0), diagonal(volume * mean_squares)};
}

Moments cuboid(const glm::dvec3& size) {
    return centred(size.x * size.y * size.z, size * size / 12.0);
}

Moments cylinder(double radius, double length) {
    const double across = radius * radius / 4.0;
    return centred(kPi * radius * radius * length, {across, length * length / 12.0, across});
}

/// The prism along y, from 0 to `height`, over what the circle of `radius` and the rectangle of half edges
/// `half` have in common.
Moments circle_in_rectangle(double radius, const glm::dvec2& half, double height) {
    const double r = radius, r2 = r * r;
    const double end = std::min(half.x, r);
    // Up to here the rectangle's long side bounds the area, from here on the circle.
    const double flat = half.y < r ? std::min(std::sqrt(r2 - half.y * half.y), end) : 0.0;
    // Antiderivatives of c, x^2 c and c^3, where c = sqrt(r^2 - x^2).
    const auto chord = [&](double x) { return std::sqrt(std::max(0.0, r2 - x * x)); };
    const auto area = [&](double x) { return (x * chord(x) + r2 * std::asin(x / r)) / 2.0; };
    const auto xx = [&](double x) {
        return (x * (2.0 * x * x - r2) * chord(x) + r2 * r2 * std::asin(x / r)) / 8.0;
    };
    const auto ccc = [&](double x) {
        return (x * (5.0 * r2 - 2.0 * x * x) * chord(x) + 3.0 * r2 * r2 * std::asin(x / r)) / 8.0;
    };
    const double z = half.y;
    const double base = 4.0 * (flat * z + area(end) - area(flat));
    const double base_xx = 4.0 * (flat * flat * flat * z / 3.0 + xx(end) - xx(flat));
    const double base_zz = 4.0 / 3.0 * (flat * z * z * z + ccc(end) - ccc(flat));
    return {base * height, glm::dvec3(0.0, base * height * height / 2.0, 0.0),
            diagonal({base_xx * height, base * height * height * height / 3.0, base_zz * height})};
}

Moments moments(const Cuboid& s) {
    return cuboid(s.size_m);
}

Moments moments(const Capsule& s) {
    const double r = s.radius_m, h = s.length_m / 2.0, r2 = r * r;
    // Two half balls, each moved by h from its flat side; its centre of mass is 3/8 r from there.
    Moments sum = centred(4.0 / 3.0 * kPi * r * r2, {r2 / 5.0, h * h + 0.75 * h * r + r2 / 5.0, r2 / 5.0});
    return sum += cylinder(r, s.length_m);
}

Moments moments(const Cylinder& s) {
    return cylinder(s.radius_m, s.length_m);
}

Moments moments(const Torus& s) {
    const double ring = s.radius_m * s.radius_m, tube = s.tube_radius_m * s.tube_radius_m;
    const double across = ring / 2.0 + 3.0 / 8.0 * tube;
    return centred(2.0 * kPi * kPi * s.radius_m * tube, {across, tube / 4.0, across});
}

Moments moments(const Ellipsoid& s) {
    const glm::dvec3& r = s.radii_m;
    return centred(4.0 / 3.0 * kPi * r.x * r.y * r.z, r * r / 5.0);
}

Moments moments(const Sphere& s) {
    return moments(Ellipsoid{glm::dvec3(s.radius_m)});
}

Moments moments(const Paddle& s) {
    const glm::dvec3 half = s.blade_m / 2.0;
    const double length = half.y + s.handle_length_m;
    Moments sum = cylinder(s.handle_radius_m, length).moved({0.0, length / 2.0, 0.0});
    const Moments common = circle_in_rectangle(s.handle_radius_m, {half.x, half.z}, half.y);
    sum += cuboid(s.blade_m);
    return sum += {-common.volume, -common.first, -common.second};
}

Moments moments(const Tetrahedron& s) {
    const double e = s.edge_m;
    return centred(e * e * e / (6.0 * std::numbers::sqrt2), glm::dvec3(e * e / 40.0));
}

struct PropertiesOf {
    template <class S>
    MassProperties operator()(const S& shape) const {
        return moments(shape).about_centre();
    }
    MassProperties operator()(const Mesh& mesh) const { return mesh.distance->mass(); }
};

}  // namespace

Moments& Moments::operator+=(const Moments& part) {
    volume += part.volume;
    first += part.first;
    second += part.second;
    return *this;
}

Moments Moments::moved(const glm::dvec3& d) const {
    const glm::dmat3 mixed = glm::outerProduct(first, d);
    return {volume, first + volume * d,
            second + mixed + glm::transpose(mixed) + volume * glm::outerProduct(d, d)};
}

MassProperties Moments::about_centre() const {
    const glm::dvec3 centre = first / volume;
    const glm::dmat3 about = moved(-centre).second;
    return {volume, centre, diagonal(glm::dvec3(about[0].x + about[1].y + about[2].z)) - about};
}

MassProperties mass_properties(const Shape& shape) {
    return std::visit(PropertiesOf{}, shape);
}

}  // namespace eddy::gles
