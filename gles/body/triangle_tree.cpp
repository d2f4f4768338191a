#include "gles/body/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace eddy::gles {
namespace {

constexpr std::ptrdiff_t kLeaf = 4;

/// Features of a triangle, in the order of their normals.
enum Feature { kA, kB, kC, kAB, kBC, kCA, kFace };

struct Nearest {
    glm::dvec3 point;
    Feature feature;
};

/// The point of a triangle nearest to p (Ericson 2005, Real-Time Collision Detection, section 5.1.5).
Nearest nearest_point(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& p) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = b - a, ac = c - a;
    const glm::dvec3 ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {a, kA};
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return {b, kB};
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return {c, kC};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + d1 / (d1 - d3) * ab, kAB};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + d2 / (d2 - d6) * ac, kCA};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), kBC};
    return {a + (vb * ab + vc * ac) / (va + vb + vc), kFace};
}

double squared(const glm::dvec3& d) {
    return glm::dot(d, d);
}

double squared_distance_to_box(const glm::dvec3& x, const glm::dvec3& low, const glm::dvec3& high) {
    return squared(x - glm::clamp(x, low, high));
}

/// Zero for a triangle so thin that it has no side.
glm::dvec3 unit_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double longest = std::max({squared(b - a), squared(c - b), squared(a - c)});
    const double twice_area = glm::length(n);
    return twice_area > 1e-12 * longest ? n / twice_area : glm::dvec3(0.0);
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
    // Sums of the normals around each corner, by angle, and at each edge.
    std::vector<glm::dvec3> of_corner(mesh.corners.size(), glm::dvec3(0.0)), of_face;
    std::vector<std::pair<std::uint64_t, glm::dvec3>> of_edge;
    const auto edge = [](std::uint32_t a, std::uint32_t b) {
        return std::uint64_t{std::min(a, b)} << 32u | std::max(a, b);
    };
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 n = unit_normal(mesh.corners[t.x], mesh.corners[t.y], mesh.corners[t.z]);
        of_face.push_back(n);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t here = t[k], next = t[(k + 1) % 3], last = t[(k + 2) % 3];
            of_edge.emplace_back(edge(here, next), n);
            if (n == glm::dvec3(0.0)) continue;
            const glm::dvec3 to_next = glm::normalize(mesh.corners[next] - mesh.corners[here]);
            const glm::dvec3 to_last = glm::normalize(mesh.corners[last] - mesh.corners[here]);
            of_corner[here] += std::acos(glm::clamp(glm::dot(to_next, to_last), -1.0, 1.0)) * n;
        }
    }
    std::sort(of_edge.begin(), of_edge.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto edge_normal = [&](std::uint32_t a, std::uint32_t b) {
        const auto first = std::lower_bound(of_edge.begin(), of_edge.end(), edge(a, b),
                                            [](const auto& e, std::uint64_t key) { return e.first < key; });
        return first->second + std::next(first)->second;
    };
    std::vector<Corners> triangles;
    Order order;
    for (const glm::uvec3& t : mesh.triangles) {
        // One without a side is left out: its edges are those of its neighbours.
        if (of_face[triangles.size()] != glm::dvec3(0.0))
            order.push_back(static_cast<std::uint32_t>(triangles.size()));
        triangles.push_back({mesh.corners[t.x], mesh.corners[t.y], mesh.corners[t.z]});
    }
    build(triangles, order.begin(), order.begin(), order.end());
    for (const std::uint32_t i : order) {
        const glm::uvec3& t = mesh.triangles[i];
        triangles_.push_back(triangles[i]);
        normals_.push_back({of_corner[t.x], of_corner[t.y], of_corner[t.z], edge_normal(t.x, t.y),
                            edge_normal(t.y, t.z), edge_normal(t.z, t.x), of_face[i]});
    }
}

std::uint32_t TriangleTree::build(const std::vector<Corners>& triangles, Order::iterator all,
                                  Order::iterator begin, Order::iterator end) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    const glm::dvec3& any = triangles[*begin][0];
    Node node{any, any, static_cast<std::uint32_t>(begin - all), static_cast<std::uint32_t>(end - begin)};
    for (auto t = begin; t != end; ++t)
        for (const glm::dvec3& x : triangles[*t]) {
            node.low = glm::min(node.low, x);
            node.high = glm::max(node.high, x);
        }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return self;

    // Half of the triangles to each side, whatever lies where: the depth stays below 32.
    const glm::dvec3 size = node.high - node.low;
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    const auto place = [&](std::uint32_t t) {
        return triangles[t][0][axis] + triangles[t][1][axis] + triangles[t][2][axis];
    };
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end,
                     [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    build(triangles, all, begin, middle);
    const std::uint32_t second = build(triangles, all, middle, end);
    nodes_[self].first = second;
    nodes_[self].count = 0;
    return self;
}

double TriangleTree::signed_distance(const glm::dvec3& x, std::uint32_t& near) const {
    Nearest nearest = nearest_point(triangles_[near], x);
    double best = squared(x - nearest.point);
    struct Visit {
        std::uint32_t node;
        double squared;
    };
    std::array<Visit, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, 0.0};
    while (depth > 0) {
        const Visit visit = stack[--depth];
        if (visit.squared >= best) continue;
        const Node& node = nodes_[visit.node];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Nearest here = nearest_point(triangles_[i], x);
            const double d = squared(x - here.point);
            if (d >= best) continue;
            best = d;
            nearest = here;
            near = i;
        }
        if (node.count > 0) continue;
        const std::uint32_t children[] = {visit.node + 1, node.first};
        double distances[2];
        for (int k = 0; k < 2; ++k)
            distances[k] = squared_distance_to_box(x, nodes_[children[k]].low, nodes_[children[k]].high);
        const int nearer = distances[0] <= distances[1] ? 0 : 1;
        stack[depth++] = {children[1 - nearer], distances[1 - nearer]};
        stack[depth++] = {children[nearer], distances[nearer]};
    }
    const double side = glm::dot(x - nearest.point, normals_[near][nearest.feature]);
    return side < 0.0 ? -std::sqrt(best) : std::sqrt(best);
}

}  // namespace eddy::gles
