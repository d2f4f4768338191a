#include "gles/body/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gles/body/triangle_tree.h"

namespace eddy::gles {
namespace {

constexpr int kFewestNodes = 8;
constexpr int kPadding = 2;  // spacings

std::size_t index(const glm::ivec3& nodes, const glm::ivec3& c) {
    return static_cast<std::size_t>((c.z * nodes.y + c.y) * nodes.x + c.x);
}

}  // namespace

DistanceGrid::DistanceGrid(const TriangleMesh& mesh, int nodes, double padding_m)
    : mesh_low_m_(mesh.corners[0]), mesh_high_m_(mesh.corners[0]), mass_(mass_properties(mesh)) {
    for (const glm::dvec3& x : mesh.corners) {
        mesh_low_m_ = glm::min(mesh_low_m_, x);
        mesh_high_m_ = glm::max(mesh_high_m_, x);
        radius_m_ = std::max(radius_m_, glm::length(x));
    }
    nodes = std::max(nodes, kFewestNodes);
    const glm::dvec3 size = mesh_high_m_ - mesh_low_m_;
    const double longest = std::max({size.x, size.y, size.z});
    spacing_m_ = std::max(longest / (nodes - 1 - 2 * kPadding), (longest + 2.0 * padding_m) / (nodes - 1));
    const double padding = std::max(padding_m, kPadding * spacing_m_);
    nodes_ = glm::ivec3(glm::ceil((size + 2.0 * padding) / spacing_m_ - 1e-9)) + 1;
    low_m_ = 0.5 * (mesh_low_m_ + mesh_high_m_) - 0.5 * spacing_m_ * glm::dvec3(nodes_ - 1);

    const TriangleTree tree(mesh);
    distances_.resize(index(nodes_, {0, 0, nodes_.z}));
    std::size_t i = 0;
    for (int z = 0; z < nodes_.z; ++z)
        for (int y = 0; y < nodes_.y; ++y) {
            std::uint32_t near = 0;  // the triangle nearest to a node is near the next node as well
            for (int x = 0; x < nodes_.x; ++x)
                distances_[i++] = static_cast<float>(
                    tree.signed_distance(low_m_ + spacing_m_ * glm::dvec3(x, y, z), near) / spacing_m_);
        }
}

DistanceGrid DistanceGrid::scaled(double times) const {
    DistanceGrid wrong = *this;
    for (float& distance : wrong.distances_) distance *= static_cast<float>(times);
    return wrong;
}

double DistanceGrid::depth_m() const {
    return -spacing_m_ * static_cast<double>(*std::min_element(distances_.begin(), distances_.end()));
}

double DistanceGrid::at(const glm::dvec3& x_m) const {
    const glm::dvec3 s = (x_m - low_m_) / spacing_m_;
    const glm::dvec3 inside = glm::clamp(s, glm::dvec3(0.0), glm::dvec3(nodes_ - 1));
    const glm::ivec3 c = glm::min(glm::ivec3(inside), nodes_ - 2);
    const glm::dvec3 f = inside - glm::dvec3(c);
    double d = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 o(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(o));
        d += w.x * w.y * w.z * static_cast<double>(distances_[index(nodes_, c + o)]);
    }
    const glm::dvec3 beyond = s - inside;
    const double squared = glm::dot(beyond, beyond);
    return spacing_m_ * (squared > 0.0 ? std::sqrt(d * d + squared) : d);
}

}  // namespace eddy::gles
