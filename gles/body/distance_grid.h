#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "gles/body/mesh.h"

namespace eddy::gles {

/// Signed distance to a mesh, negative inside, on a regular grid of nodes in the mesh's own frame: what the
/// shaders sample, and all that is kept of the mesh. Linear between nodes, so edges sharper than a spacing
/// come out rounded.
///
/// Outside the grid, at the distance o from its box, it is sqrt(d^2 + o^2) with d from the nearest point of
/// the box. The box is convex, so no surface inside it is nearer than that: a ray that steps by this distance
/// never steps over the mesh.
class DistanceGrid {
  public:
    /// `nodes` along the longest edge of the box. Around the mesh, at least `padding_m` and two spacings are
    /// free; with padding of two cells of the fluid, the fluid only ever uses distances from inside the box.
    explicit DistanceGrid(const TriangleMesh& mesh, int nodes = 64, double padding_m = 0.0);

    /// The same with distances that are none: so many times what they are. For the laboratory.
    DistanceGrid scaled(double times) const;

    /// [m], at x in the mesh's frame.
    double at(const glm::dvec3& x_m) const;

    glm::ivec3 nodes() const { return nodes_; }
    double spacing_m() const { return spacing_m_; }
    glm::dvec3 low_m() const { return low_m_; }  ///< where the first node is
    /// At the nodes, x fastest, in spacings.
    const std::vector<float>& distances() const { return distances_; }

    // Of the mesh itself.
    glm::dvec3 mesh_low_m() const { return mesh_low_m_; }
    glm::dvec3 mesh_high_m() const { return mesh_high_m_; }
    double radius_m() const { return radius_m_; }  ///< of the ball around the origin that holds it
    double depth_m() const;                        ///< of the node deepest inside
    const MassProperties& mass() const { return mass_; }

  private:
    glm::ivec3 nodes_{0};
    double spacing_m_ = 0.0;
    glm::dvec3 low_m_{0.0};
    std::vector<float> distances_;
    glm::dvec3 mesh_low_m_, mesh_high_m_;
    double radius_m_ = 0.0;
    MassProperties mass_;
};

}  // namespace eddy::gles
