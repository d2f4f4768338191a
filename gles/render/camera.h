#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

namespace eddy::gles {

/// A camera that circles the middle of the tank and looks at it. Angles as a visitor would walk and rise; the
/// frame is Tank (hal/frames.h). It has no degenerate pose: straight from above, the right edge of the
/// picture still is the camera's own right.
struct Camera {
    double azimuth_deg = 20.0;    ///< 0 in front of the tank (+z), 90 on its right (+x)
    double elevation_deg = 15.0;  ///< 0 level with the middle of the tank, 90 above it
    double distance = 1.5;        ///< from the middle of the tank, in tank diagonals
    double field_deg = 38.0;      ///< seen across the shorter side of the picture

    /// Unit vector from the middle of the tank to the eye.
    glm::dvec3 backward() const {
        const double az = glm::radians(azimuth_deg), el = glm::radians(elevation_deg);
        return {std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el)};
    }
    glm::dvec3 right() const {
        const double az = glm::radians(azimuth_deg);
        return {std::cos(az), 0.0, -std::sin(az)};
    }
    glm::dvec3 up() const { return glm::cross(backward(), right()); }

    glm::dvec3 eye(const glm::dvec3& tank_size) const {
        return 0.5 * tank_size + distance * glm::length(tank_size) * backward();
    }
    /// Columns that turn (x, y, 1) into the direction of a ray (not a unit vector), where x and y run from -1
    /// to 1 across a picture of this width / height.
    glm::dmat3 rays(double aspect) const {
        const double half = std::tan(0.5 * glm::radians(field_deg));
        return {right() * half * std::max(aspect, 1.0), up() * half * std::max(1.0 / aspect, 1.0),
                -backward()};
    }
};

}  // namespace eddy::gles
