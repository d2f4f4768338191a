#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "hal/haptic/falcon/protocol.h"

namespace eddy::falcon {

// Encoder counts <-> metres, newtons <-> motor units. Pure, double precision. The handle hangs on three legs;
// each leg is a driven arm (angle theta1), then a parallelogram (theta2 in the plane of the arm, theta3 out
// of it), after Stamper's parallel manipulator as Ouellet applied it to the Falcon.
//
// Base frame: the Falcon's own. x right, y up, z out towards the visitor, origin in the middle of the base
// plane. The Device frame (hal/frames.h) has the same axes and starts at the middle of the workspace:
inline constexpr double kDeviceOriginZ = 0.125;  ///< [m]; the origin vrpn_Tracker_NovintFalcon.C uses

inline glm::dvec3 base_from_device(const glm::dvec3& p) {
    return {p.x, p.y, p.z + kDeviceOriginZ};
}
inline glm::dvec3 device_from_base(const glm::dvec3& p) {
    return {p.x, p.y, p.z - kDeviceOriginZ};
}

/// Angles of the driven arms [rad]: top, right, left.
using ArmAngles = std::array<double, 3>;

/// Motor units per newton metre at the arm. Found by trial by libnifalcon's authors; published traces hint at
/// 3-5 times less, so it is a setting.
inline constexpr double kMotorUnitsPerNm = 10000.0;

double arm_angle(double count);
double encoder_count(double arm_angle);
ArmAngles arm_angles(const Axes& counts);

/// All joint angles of the three legs [rad].
struct Legs {
    ArmAngles theta1{};
    ArmAngles theta2{};
    ArmAngles theta3{};
};

/// The joint angles that put the handle at p [m, Base]; nothing where the legs cannot reach, or
/// only past a singular pose.
std::optional<Legs> inverse_kinematics(const glm::dvec3& p);

/// J in  d(theta1)/dt = J dp/dt  [rad/m]: row i is leg i, so J[axis][leg] in GLM's column-first order.
glm::dmat3 jacobian(const Legs& legs);

/// Finds the position of the handle from the arm angles by Newton's method, starting from the last position
/// found.
class ForwardKinematics {
  public:
    /// Position [m, Base], good to 1e-9 m; nothing if it finds no pose of the handle with these angles.
    std::optional<glm::dvec3> solve(const ArmAngles& angles);

  private:
    glm::dvec3 last_{0.0, 0.0, 0.11};
};

struct MotorForce {
    Axes motors{};
    bool saturated =
        false;  ///< the force was more than the motors can give, so all three were scaled down together
};

/// Motor values that push the hand with force_n [N] where the legs stand so. A force that is not finite gives
/// zero.
MotorForce motors_for(const Legs& legs, const glm::dvec3& force_n, double motor_units_per_nm);

/// The force [N] on the hand that these motor values make.
glm::dvec3 force_of(const Legs& legs, const Axes& motors, double motor_units_per_nm);

}  // namespace eddy::falcon
