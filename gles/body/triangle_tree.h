#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gles/body/mesh.h"

namespace eddy::gles {

/// Exact signed distance to a mesh, negative inside: a tree of boxes finds the nearest point, and the
/// pseudonormal of the face, edge or corner it lies on tells the side (Baerentzen & Aanaes 2005, IEEE Trans.
/// Vis. Comput. Graph. 11). That is right wherever the surface does not cut itself.
class TriangleTree {
  public:
    explicit TriangleTree(const TriangleMesh& mesh);

    /// `near`: a triangle to try first, which makes it faster if it is near, and becomes the nearest.
    double signed_distance(const glm::dvec3& x, std::uint32_t& near) const;

  private:
    using Corners = std::array<glm::dvec3, 3>;
    /// Of corners a, b, c, of edges ab, bc, ca, of the face.
    using Normals = std::array<glm::dvec3, 7>;
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t first;  ///< triangle of a leaf; else the second child
        std::uint32_t count;  ///< of triangles; 0: not a leaf
    };
    using Order = std::vector<std::uint32_t>;
    std::uint32_t build(const std::vector<Corners>& triangles, Order::iterator all, Order::iterator begin,
                        Order::iterator end);

    std::vector<Corners> triangles_;  ///< in the order of the tree's leaves
    std::vector<Normals> normals_;
    std::vector<Node> nodes_;  ///< the root is the first; a node's first child follows it
};

}  // namespace eddy::gles
