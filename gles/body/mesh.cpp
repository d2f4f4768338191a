#include "gles/body/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace eddy::gles {
namespace {

constexpr std::size_t kMostTriangles = 2'000'000;
constexpr double kFarthest_m = 1e6, kSmallest_m = 1e-9;

std::string shown(const glm::dvec3& x) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x, x.y, x.z);
}

/// To metres; refuses what is no place.
void scale(TriangleSoup& soup, double scale_m) {
    for (std::size_t i = 0; i < soup.corners.size(); ++i) {
        glm::dvec3& x = soup.corners[i];
        x *= scale_m;
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(x[axis]))
                soup.refuse(soup.places[i / 3], "a coordinate is not a finite number: export the mesh again");
            if (std::abs(x[axis]) > kFarthest_m)
                soup.refuse(soup.places[i / 3],
                            fmt::format("a coordinate of {:.3g} m is out of reach: is the scale of {:g} m "
                                        "for one unit of the file right?",
                                        x[axis], scale_m));
        }
    }
}

/// Gives each place one number, and drops triangles that use a place twice: without them the rest is as
/// closed as before.
TriangleMesh weld(TriangleSoup& soup) {
    const std::vector<glm::dvec3>& x = soup.corners;
    std::vector<std::uint32_t> order(x.size()), number(x.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::tie(x[i].x, x[i].y, x[i].z); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    TriangleMesh mesh;
    for (const std::uint32_t i : order) {
        if (mesh.corners.empty() || mesh.corners.back() != x[i]) mesh.corners.push_back(x[i]);
        number[i] = static_cast<std::uint32_t>(mesh.corners.size() - 1);
    }
    std::vector<std::size_t> places;
    for (std::size_t t = 0; t < soup.places.size(); ++t) {
        const glm::uvec3 triangle(number[3 * t], number[3 * t + 1], number[3 * t + 2]);
        if (triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x) continue;
        mesh.triangles.push_back(triangle);
        places.push_back(soup.places[t]);
    }
    soup.places = std::move(places);
    return mesh;
}

struct Edge {
    std::uint32_t low, high;
    bool upward;  ///< its triangle runs from low to high
    std::uint32_t triangle;
    bool same(const Edge& e) const { return low == e.low && high == e.high; }
};

void require_closed(const TriangleMesh& mesh, const TriangleSoup& soup) {
    std::vector<Edge> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<std::uint32_t>(t)});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    std::size_t wrong = 0, users = 0;
    Edge first{};
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
        while (end < edges.size() && edges[end].same(edges[i])) ++end;
        if (end - i == 2 && edges[i].upward != edges[i + 1].upward) continue;
        if (wrong++ == 0 || edges[i].triangle < first.triangle) {
            first = edges[i];
            users = end - i;
        }
    }
    if (wrong == 0) return;
    const std::string edge = fmt::format("the edge from {} to {} m", shown(mesh.corners[first.low]),
                                         shown(mesh.corners[first.high]));
    const std::string others = wrong == 1 ? "" : fmt::format(" ({} edges are like that)", wrong);
    if (users == 2)
        soup.refuse(
            soup.places[first.triangle],
            fmt::format("the two triangles at {} have opposite outsides{}: make the normals consistent "
                        "in a mesh editor",
                        edge, others));
    soup.refuse(
        soup.places[first.triangle],
        fmt::format("the surface is not closed: {} belongs to {} triangle{}, not 2{}; close holes and "
                    "remove inner walls in a mesh editor",
                    edge, users, users == 1 ? "" : "s", others));
}

/// Volume and its moments: tetrahedra from `origin` to each triangle (Tonon 2004, J. Math. Stat. 1, for one
/// tetrahedron).
Moments moments(const TriangleMesh& mesh, const glm::dvec3& origin) {
    Moments sum;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.corners[t.x] - origin, b = mesh.corners[t.y] - origin,
                         c = mesh.corners[t.z] - origin;
        const double six = glm::dot(a, glm::cross(b, c));
        const glm::dvec3 s = a + b + c;
        sum += {six / 6.0, six / 24.0 * s,
                six / 120.0 *
                    (glm::outerProduct(s, s) + glm::outerProduct(a, a) + glm::outerProduct(b, b) +
                     glm::outerProduct(c, c))};
    }
    return sum;
}

}  // namespace

void TriangleSoup::refuse(std::size_t place, const std::string& why) const {
    throw MeshError(counts_lines ? fmt::format("{}:{}: {}", name, place, why)
                                 : fmt::format("{}: byte {}: {}", name, place, why));
}

void TriangleSoup::add(const std::array<glm::dvec3, 3>& triangle, std::size_t place) {
    if (places.size() == kMostTriangles)
        refuse(place,
               fmt::format("more than {} triangles: simplify the mesh; the fluid's cells are far coarser",
                           kMostTriangles));
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    places.push_back(place);
}

TriangleMesh closed_mesh(TriangleSoup soup, double scale_m) {
    if (soup.places.empty())
        throw MeshError(fmt::format("{}: no triangles in it: is it the right file?", soup.name));
    scale(soup, scale_m);
    TriangleMesh mesh = weld(soup);
    if (mesh.triangles.empty())
        throw MeshError(fmt::format(
            "{}: every triangle has two corners at the same place: export the mesh again", soup.name));
    require_closed(mesh, soup);

    glm::dvec3 low = mesh.corners[0], high = low;
    for (const glm::dvec3& x : mesh.corners) {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    const double volume = moments(mesh, low).volume, size = glm::length(high - low);
    if (size < kSmallest_m)
        throw MeshError(fmt::format(
            "{}: {:.3g} m from end to end is no size: is the scale of {:g} m for one unit of the file right?",
            soup.name, size, scale_m));
    if (std::abs(volume) < 1e-9 * size * size * size)
        throw MeshError(fmt::format(
            "{}: the surface encloses no volume: give it thickness, or make its normals point outward",
            soup.name));
    if (volume < 0.0)
        for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

MassProperties mass_properties(const TriangleMesh& mesh) {
    const glm::dvec3 origin = mesh.corners[0];  // near the surface, so that little cancels
    MassProperties mass = moments(mesh, origin).about_centre();
    mass.centre_m += origin;
    return mass;
}

}  // namespace eddy::gles
