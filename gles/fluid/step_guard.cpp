#include "gles/fluid/step_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gles/body/bounds.h"

namespace eddy::gles {
namespace {

/// A rounding error of a quaternion that was computed in doubles, many times over.
constexpr double kUnitTolerance = 1e-6;
/// Cells between a body that is far outside and the tank beyond its own size: nothing of it is drawn there.
constexpr double kMarginCells = 3.0;
/// Squares of it, and sums of them, are numbers still.
constexpr double kMostPhi = 1e15;

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 size_m(const FluidSetup& setup) {
    return setup.cell_m * glm::dvec3(setup.cells);
}

double longest_side_m(const FluidSetup& setup) {
    const glm::dvec3 size = size_m(setup);
    return std::max({size.x, size.y, size.z});
}

/// No part of it is in the tank from there on, nor near it.
glm::dvec3 far_outside_m(const Shape& shape, const FluidSetup& setup) {
    return glm::dvec3(-3.0 * bounding_ball(shape).radius_m - kMarginCells * setup.cell_m);
}

/// Its largest component first, so that no square overflows or vanishes.
glm::dquat unit(const glm::dquat& q) {
    const double largest = std::max({std::abs(q.w), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    if (largest == 0.0) return {1.0, 0.0, 0.0, 0.0};
    return glm::normalize(glm::dquat(q.w / largest, q.x / largest, q.y / largest, q.z / largest));
}

bool is_unit(const glm::dquat& q) {
    return std::abs(glm::length(q) - 1.0) <= kUnitTolerance;
}

/// The vector, no longer than `longest`.
glm::dvec3 shortened(const glm::dvec3& v, double longest) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0.0) return v;
    const glm::dvec3 scaled = v / largest;
    const double length = glm::length(scaled);
    return largest > longest / length ? scaled * (longest / length) : v;
}

}  // namespace

GuardCounts& GuardCounts::operator+=(const GuardCounts& other) {
    step_refused += other.step_refused;
    step_shortened += other.step_shortened;
    body_not_finite += other.body_not_finite;
    body_not_unit += other.body_not_unit;
    body_far += other.body_far;
    body_too_fast += other.body_too_fast;
    unsound_steps += other.unsound_steps;
    return *this;
}

bool is_finite(const BodyState& s) {
    return is_finite(s.centre_m) && is_finite(s.velocity_m_s) && is_finite(s.spin_rad_s) &&
           std::isfinite(s.orientation.w) && std::isfinite(s.orientation.x) &&
           std::isfinite(s.orientation.y) && std::isfinite(s.orientation.z);
}

bool is_finite(const Load& load) {
    return is_finite(load.force_n) && is_finite(load.torque_nm);
}

Sound sound(const FluidSetup& setup, double dt_s) {
    const double fastest = kFluidLengths * longest_side_m(setup) / dt_s;
    // That of a flow that crosses the tank in a step and is stopped in it, p = rho (L / dt)^2, times 1 + nu dt / h^2 where it is
    // friction that stops it; of a weight that is held; and eight times that.
    const double stiff = 1.0 + static_cast<double>(diffusion_number(setup, dt_s));
    const double crosses = longest_side_m(setup) / dt_s * stiff;
    const double falls = dt_s * glm::length(setup.gravity_m_s2);
    const double most = 8.0 * (crosses + falls) * longest_side_m(setup) / setup.cell_m;
    return {static_cast<float>(std::min(fastest, kMostPhi)),
            static_cast<float>(std::min(fastest * stiff, kMostPhi)),
            static_cast<float>(std::min(most, kMostPhi))};
}

double fastest_body_m_s(const FluidSetup& setup, double dt_s) {
    return kBodyLengths * longest_side_m(setup) / dt_s;
}

bool slow_down(BodyState& body, const Shape& shape, double fastest_m_s) {
    const BodyState was = body;
    body.velocity_m_s = shortened(body.velocity_m_s, fastest_m_s);
    const double radius_m = bounding_radius_m(shape);
    if (radius_m > 0.0) body.spin_rad_s = shortened(body.spin_rad_s, fastest_m_s / radius_m);
    return body.velocity_m_s != was.velocity_m_s || body.spin_rad_s != was.spin_rad_s;
}

std::pair<std::string, std::string> farthest(const FluidSetup& setup) {
    const int cells = std::max({setup.cells.x, setup.cells.y, setup.cells.z});
    return {"FARTHEST", fmt::format("{:.1f}", kFluidLengths * cells)};
}

std::optional<double> guarded_step_s(double dt_s, const FluidSetup& setup, GuardCounts& counts) {
    // guard step_refused: forces are divided by dt
    if (!std::isfinite(dt_s) || dt_s <= 0.0 || dt_s < setup.shortest_step_s) {
        ++counts.step_refused;
        return std::nullopt;
    }
    // guard step_shortened
    if (dt_s > setup.longest_step_s) {
        ++counts.step_shortened;
        return setup.longest_step_s;
    }
    return dt_s;
}

std::vector<BodyState> guarded_bodies(std::vector<BodyState> given, const std::vector<BodyState>& before,
                                      const FluidSetup& setup, double dt_s, GuardCounts& counts) {
    const double fastest_m_s = fastest_body_m_s(setup, dt_s);
    for (std::size_t i = 0; i < given.size(); ++i) {
        BodyState& body = given[i];
        const Shape& shape = setup.bodies[i].shape;
        // guard body_not_finite
        if (!is_finite(body)) {
            ++counts.body_not_finite;
            body = {.centre_m = far_outside_m(shape, setup)};
            if (i < before.size()) {
                body = before[i];
                body.velocity_m_s = body.spin_rad_s = glm::dvec3(0.0);
            }
        }
        // guard body_not_unit: a longer one would be a larger body, with another volume
        if (!is_unit(body.orientation)) {
            ++counts.body_not_unit;
            body.orientation = unit(body.orientation);
        }
        // guard body_far: counted in cells, a place must be an integer
        const glm::dvec3 low = far_outside_m(shape, setup), high = size_m(setup) - low;
        const glm::dvec3 to_middle = body.orientation * bounding_ball(shape).centre_m;
        const glm::dvec3 middle = body.centre_m + to_middle, inside = glm::clamp(middle, low, high);
        if (inside != middle) {
            ++counts.body_far;
            body.centre_m = inside - to_middle;
        }
        // guard body_too_fast
        if (slow_down(body, shape, fastest_m_s)) ++counts.body_too_fast;
    }
    return given;
}

}  // namespace eddy::gles
