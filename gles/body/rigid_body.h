#pragma once
#include <array>

#include "gles/body/mass_properties.h"

namespace eddy::gles {

/// Six numbers, Tank frame: of the body's centre and of turning about it, x y z each.
using Vector6 = std::array<double, 6>;
using Matrix6 = std::array<Vector6, 6>;

/// A solid of one density all through, as mechanics sees it. Its centre of mass need not be its centre.
class RigidBody {
  public:
    RigidBody(const Shape& shape, double density_kg_m3);

    /// M in  (momentum, angular momentum about the centre) = M (velocity of the centre, spin).
    Matrix6 mass_matrix(const glm::dquat& orientation) const;
    /// Momentum of `before`, and its angular momentum about where the centre is when turned to `orientation`: what the
    /// body has there as long as nothing acts on it.
    Vector6 momentum(const BodyState& before, const glm::dquat& orientation) const;
    /// Where it is dt later. The centre of mass goes straight on; velocity and spin are left as they are.
    BodyState moved(const BodyState& state, double dt_s) const;

  private:
    /// From the centre to the centre of mass.
    glm::dvec3 arm_m(const glm::dquat& orientation) const { return orientation * centre_of_mass_m_; }
    /// About the centre of mass.
    glm::dmat3 inertia_kg_m2(const glm::dquat& orientation) const;

    double mass_kg_;
    glm::dvec3 centre_of_mass_m_;  // in the body's frame, as is:
    glm::dmat3 inertia_kg_m2_;
};

/// The orientation dt later, turning steadily.
glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& spin_rad_s, double dt_s);

}  // namespace eddy::gles
