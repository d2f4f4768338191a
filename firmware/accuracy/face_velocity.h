#pragma once
#include <functional>
#include <vector>

#include "gles/fluid/fluid.h"

namespace eddy::accuracy {

/// The velocity of a fluid on its staggered grid: component k of u(c) lies on the lower face k of cell c.
class FaceVelocity {
  public:
    explicit FaceVelocity(const gles::Fluid& fluid);

    const glm::ivec3& cells() const { return cells_; }
    double cell_m() const { return cell_m_; }
    double at(const glm::ivec3& cell, int k) const;
    /// All of it, as gles::Fluid::velocity() gives it.
    const std::vector<glm::vec3>& values() const { return u_; }
    /// Middle of that face [m].
    glm::dvec3 place_m(const glm::ivec3& cell, int k) const;
    /// Calls for each face of the tank, walls included; `share`: the part of a cell's volume that belongs to the face,
    /// 1, or 1/2 on a wall.
    void for_each_face(const std::function<void(const glm::ivec3& cell, int k, double share)>& visit) const;

    /// Greatest of |u| over the corners of the grid [m/s]; each component from its own face.
    double fastest_m_s() const;
    /// Half the mean of u^2 [m2/s2].
    double energy() const;
    /// Mean of |curl u|^2 [1/s2] in a tank of slip walls, where the tangential parts vanish on the walls.
    double mean_square_vorticity() const;

  private:
    glm::ivec3 cells_;
    double cell_m_;
    std::vector<glm::vec3> u_;
};

using VelocityFormula = std::function<glm::dvec3(const glm::dvec3& place_m)>;

/// rms of u - exact over the faces, relative to the rms of exact.
double relative_l2(const FaceVelocity& u, const VelocityFormula& exact);

/// a in u = a mode + what is square to mode, over the faces.
double amplitude(const FaceVelocity& u, const VelocityFormula& mode);

}  // namespace eddy::accuracy
