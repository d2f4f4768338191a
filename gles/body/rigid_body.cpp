#include "gles/body/rigid_body.h"

namespace eddy::gles {

RigidBody::RigidBody(const Shape& shape, double density_kg_m3) {
    const MassProperties m = mass_properties(shape);
    mass_kg_ = density_kg_m3 * m.volume_m3;
    centre_of_mass_m_ = m.centre_m;
    inertia_kg_m2_ = density_kg_m3 * m.inertia_m5;
}

glm::dmat3 RigidBody::inertia_kg_m2(const glm::dquat& orientation) const {
    const glm::dmat3 r = glm::mat3_cast(orientation);
    return r * inertia_kg_m2_ * glm::transpose(r);
}

Matrix6 RigidBody::mass_matrix(const glm::dquat& orientation) const {
    const glm::dvec3 arm = arm_m(orientation);
    const glm::dmat3 inertia = inertia_kg_m2(orientation);
    Matrix6 matrix{};
    // Column by column: the momenta of unit motions.
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 unit(0.0);
        unit[k] = 1.0;
        const glm::dvec3 moving = mass_kg_ * unit, turning = mass_kg_ * glm::cross(unit, arm);
        const glm::dvec3 moving_about = glm::cross(arm, moving);
        const glm::dvec3 turning_about = inertia * unit + glm::cross(arm, turning);
        const auto column = static_cast<std::size_t>(k);
        for (int i = 0; i < 3; ++i) {
            const auto row = static_cast<std::size_t>(i);
            matrix[row][column] = moving[i];
            matrix[row + 3][column] = moving_about[i];
            matrix[row][column + 3] = turning[i];
            matrix[row + 3][column + 3] = turning_about[i];
        }
    }
    return matrix;
}

Vector6 RigidBody::momentum(const BodyState& before, const glm::dquat& orientation) const {
    const glm::dvec3 linear =
        mass_kg_ * (before.velocity_m_s + glm::cross(before.spin_rad_s, arm_m(before.orientation)));
    const glm::dvec3 angular =
        inertia_kg_m2(before.orientation) * before.spin_rad_s + glm::cross(arm_m(orientation), linear);
    return {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
}

BodyState RigidBody::moved(const BodyState& state, double dt_s) const {
    BodyState later = state;
    const glm::dvec3 arm = arm_m(state.orientation);
    later.orientation = turned(state.orientation, state.spin_rad_s, dt_s);
    later.centre_m = state.centre_m + arm + dt_s * (state.velocity_m_s + glm::cross(state.spin_rad_s, arm)) -
                     arm_m(later.orientation);
    return later;
}

glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& spin_rad_s, double dt_s) {
    const double spin = glm::length(spin_rad_s);
    if (spin == 0.0) return orientation;
    return glm::normalize(glm::angleAxis(spin * dt_s, spin_rad_s / spin) * orientation);
}

}  // namespace eddy::gles
