#include "hal/haptic/falcon/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eddy::falcon {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Lengths in metres, named as in libnifalcon FalconGeometry.h (values of 2009 and later).
constexpr double kA = 0.060;     // driven arm
constexpr double kB = 0.1025;    // long side of the parallelogram
constexpr double kC = 0.01443;   // pin on the handle's platform, radial
constexpr double kD = 0.01125;   // hinge offsets at the two ends of the parallelogram: d = e
constexpr double kF = -0.025;    // pin on the handle's platform, tangential
constexpr double kR = 0.0400;    // arm pivot on the base, radial
constexpr double kS = -0.02309;  // arm pivot on the base, tangential
constexpr std::array<double, 3> kPhi{105.0 * kDegree, -15.0 * kDegree, -135.0 * kDegree};

// Encoder: 320 lines, read fourfold; capstan 14.25 mm on a 110 mm drum; zero near 35 degrees (libnifalcon
// FalconGeometry.h).
constexpr double kRadiansPerCount = 2.0 * std::numbers::pi / (4.0 * 320.0) * (14.25 / 110.0);
constexpr double kZeroAngle = 35.0 * kDegree;

// Where the determinant of J passes zero, the same arm angles belong to two poses and forces grow without
// bound. Within 60 mm of the middle that happens only in the far corners; in the middle it is -3900.
constexpr double kNearlySingular = -300.0;  // [rad^3/m^3]

constexpr double kTolerance = 1e-9;    // [m] of the last Newton step; what is left is its square
constexpr double kLongestStep = 0.02;  // [m]; near a singular pose Newton would fly off
constexpr double kSameAngle = 1e-5;    // [rad]
constexpr int kMaxSteps = 20;          // 3 or 4 are enough nearly everywhere

struct Leg {
    double theta1, theta2, theta3;
};

/// Turns p into the plane of leg i: u along the arm's radius, v across it, w = z.
glm::dvec3 into_leg(std::size_t i, const glm::dvec3& p) {
    const double c = std::cos(kPhi[i]);
    const double s = std::sin(kPhi[i]);
    return {c * p.x + s * p.y - kR, -s * p.x + c * p.y - kS, p.z};
}

std::optional<Leg> solve_leg(std::size_t i, const glm::dvec3& p) {
    const glm::dvec3 in_leg = into_leg(i, p);
    const double across = (in_leg.y + kF) / kB;
    if (!(std::abs(across) < 1.0)) return std::nullopt;
    const double theta3 = std::acos(across);

    // In the plane of the arm: two rods, a and L, from the pivot (0,0) to the hinge (U,w). The elbow bends
    // outwards.
    const double rod = 2.0 * kD + kB * std::sin(theta3);
    const double hinge_u = in_leg.x + kC;
    const double hinge_w = in_leg.z;
    const double reach = std::hypot(hinge_u, hinge_w);
    const double cos_inner = (reach * reach + kA * kA - rod * rod) / (2.0 * kA * reach);
    if (!(std::abs(cos_inner) < 1.0)) return std::nullopt;
    const double theta1 = std::atan2(hinge_w, hinge_u) - std::acos(cos_inner);
    const double theta2 = std::atan2(hinge_w - kA * std::sin(theta1), hinge_u - kA * std::cos(theta1));
    return Leg{theta1, theta2, theta3};
}

/// A start for Newton: takes each parallelogram for a rod of fixed length from elbow to handle and meets
/// three spheres. Good to 5 mm.
std::optional<glm::dvec3> three_sphere_guess(const ArmAngles& angles) {
    constexpr double kRod = kB + 2.0 * kD;
    std::array<glm::dvec3, 3> knee;
    for (std::size_t i = 0; i < 3; ++i) {
        const double u = kA * std::cos(angles[i]) - kC + kR;
        const double v = kS - kF;
        const double c = std::cos(kPhi[i]);
        const double s = std::sin(kPhi[i]);
        knee[i] = {c * u - s * v, s * u + c * v, kA * std::sin(angles[i])};
    }
    const glm::dvec3 ex = glm::normalize(knee[1] - knee[0]);
    const glm::dvec3 to_third = knee[2] - knee[0];
    const double i = glm::dot(ex, to_third);
    const glm::dvec3 ey = glm::normalize(to_third - i * ex);
    const double x = glm::length(knee[1] - knee[0]) / 2.0;
    const double j = glm::dot(ey, to_third);
    const double y = (i * i + j * j - 2.0 * i * x) / (2.0 * j);
    const double z2 = kRod * kRod - x * x - y * y;
    if (!(z2 >= 0.0)) return std::nullopt;
    const glm::dvec3 foot = knee[0] + x * ex + y * ey;
    const glm::dvec3 out = std::sqrt(z2) * glm::cross(ex, ey);
    return out.z > 0.0 ? foot + out : foot - out;
}

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// How much too far the handle is from the elbow of leg i, squared: 0 when the leg closes. Smooth where the
/// arm angle as a function of p is not, with a straight arm.
struct Closure {
    double error;          // [m^2]
    glm::dvec3 direction;  // its gradient  [m]
};
std::optional<Closure> closure(std::size_t i, const glm::dvec3& p, double theta1) {
    const glm::dvec3 in_leg = into_leg(i, p);
    const double cos3 = (in_leg.y + kF) / kB;
    if (!(std::abs(cos3) < 1.0)) return std::nullopt;
    const double sin3 = std::sqrt(1.0 - cos3 * cos3);
    const double rod = 2.0 * kD + kB * sin3;
    const double u = in_leg.x + kC - kA * std::cos(theta1);
    const double w = in_leg.z - kA * std::sin(theta1);
    const double along_u = 2.0 * u;
    const double along_v = 2.0 * rod * cos3 / sin3;
    const double c = std::cos(kPhi[i]);
    const double s = std::sin(kPhi[i]);
    return Closure{u * u + w * w - rod * rod,
                   {c * along_u - s * along_v, s * along_u + c * along_v, 2.0 * w}};
}

std::optional<glm::dvec3> newton(glm::dvec3 p, const ArmAngles& wanted) {
    for (int steps = 0; steps < kMaxSteps; ++steps) {
        glm::dvec3 error;
        glm::dmat3 rows;
        for (int leg = 0; leg < 3; ++leg) {
            const auto i = static_cast<std::size_t>(leg);
            const auto closes = closure(i, p, wanted[i]);
            if (!closes) return std::nullopt;
            error[leg] = closes->error;
            rows[leg] = closes->direction;
        }
        glm::dvec3 step = glm::inverse(glm::transpose(rows)) * error;
        step *= std::min(1.0, kLongestStep / glm::length(step));
        p -= step;
        if (largest(step) > kTolerance) continue;
        // The legs also close with an elbow bent inwards: then this is another pose.
        const auto legs = inverse_kinematics(p);
        if (!legs) return std::nullopt;
        for (std::size_t i = 0; i < 3; ++i)
            if (std::abs(legs->theta1[i] - wanted[i]) > kSameAngle) return std::nullopt;
        return p;
    }
    return std::nullopt;
}

}  // namespace

double arm_angle(double count) {
    return kZeroAngle + kRadiansPerCount * count;
}
double encoder_count(double arm_angle) {
    return (arm_angle - kZeroAngle) / kRadiansPerCount;
}

ArmAngles arm_angles(const Axes& counts) {
    return {arm_angle(counts[0]), arm_angle(counts[1]), arm_angle(counts[2])};
}

std::optional<Legs> inverse_kinematics(const glm::dvec3& p) {
    Legs legs;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto leg = solve_leg(i, p);
        if (!leg) return std::nullopt;
        legs.theta1[i] = leg->theta1;
        legs.theta2[i] = leg->theta2;
        legs.theta3[i] = leg->theta3;
    }
    if (!(glm::determinant(jacobian(legs)) < kNearlySingular)) return std::nullopt;
    return legs;
}

glm::dmat3 jacobian(const Legs& legs) {
    glm::dmat3 j;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto leg = static_cast<glm::dmat3::length_type>(i);
        const double s2 = std::sin(legs.theta2[i]);
        const double c2 = std::cos(legs.theta2[i]);
        const double s3 = std::sin(legs.theta3[i]);
        const double c3 = std::cos(legs.theta3[i]);
        const double d = -kA * s3 * std::sin(legs.theta1[i] - legs.theta2[i]);
        const double cp = std::cos(kPhi[i]);
        const double sp = std::sin(kPhi[i]);
        j[0][leg] = (cp * c2 * s3 - sp * c3) / d;
        j[1][leg] = (sp * c2 * s3 + cp * c3) / d;
        // libnifalcon squares s2 here (its issue 66) and so pushes 9-36 % too hard along z.
        j[2][leg] = s2 * s3 / d;
    }
    return j;
}

std::optional<glm::dvec3> ForwardKinematics::solve(const ArmAngles& angles) {
    auto found = newton(last_, angles);
    if (!found) {
        const auto guess = three_sphere_guess(angles);
        if (guess) found = newton(*guess, angles);
    }
    if (found) last_ = *found;
    return found;
}

MotorForce motors_for(const Legs& legs, const glm::dvec3& force_n, double motor_units_per_nm) {
    // Virtual work: torque . J dp = force . dp for every dp, so  torque = J^-T force.
    const glm::dvec3 torque = glm::inverse(glm::transpose(jacobian(legs))) * force_n;
    glm::dvec3 motors = -motor_units_per_nm * torque;
    const double peak = largest(motors);
    if (!std::isfinite(motors.x + motors.y + motors.z)) return {};
    const bool saturated = peak > kMaxMotor;
    if (saturated) motors *= kMaxMotor / peak;
    const auto rounded = [](double value) { return static_cast<int>(std::lround(value)); };
    return {{rounded(motors.x), rounded(motors.y), rounded(motors.z)}, saturated};
}

glm::dvec3 force_of(const Legs& legs, const Axes& motors, double motor_units_per_nm) {
    const glm::dvec3 torque = -glm::dvec3(motors[0], motors[1], motors[2]) / motor_units_per_nm;
    return glm::transpose(jacobian(legs)) * torque;
}

}  // namespace eddy::falcon
