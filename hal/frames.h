#pragma once
#include <glm/glm.hpp>

namespace eddy {

// Every frame Eddy uses, once. All are right-handed; lengths in metres unless the name says otherwise.
//
//         y up
//         |
//         o------ x right
//        /
//       z to the visitor
//
// Device  origin in the middle of the handle's workspace (Falcon: z = 0.125 m from the base plane);
//         x right, y up, z out of the device towards the visitor.
// Tank    origin at the low corner of the fluid; x right, y up, z towards the visitor.
//         The fluid fills (0,0,0) .. size_m.
// Cell    Tank divided by the cell width h: cell (i,j,k) fills (i,j,k) .. (i+1,j+1,k+1), its centre is at
//         (i+1/2, j+1/2, k+1/2).
// Atlas   texels of the 2D texture that holds the slices of a Cell-frame field; only gles/atlas.glsl and
//         gles/atlas.h know how they are laid out.

/// Maps the Device frame into the Tank frame: p_tank = centre_m + scale * p_device. No rotation: both have y
/// up. Directions (velocity) are multiplied by `scale`; a force keeps its direction and is scaled by the
/// haptic gain alone.
struct TankFromDevice {
    glm::dvec3 centre_m{0.0};  ///< tank point under the device's origin
    double scale = 1.0;        ///< tank metres per device metre

    glm::dvec3 position(const glm::dvec3& p_device) const { return centre_m + scale * p_device; }
    glm::dvec3 velocity(const glm::dvec3& v_device) const { return scale * v_device; }
    glm::dvec3 device_position(const glm::dvec3& p_tank) const { return (p_tank - centre_m) / scale; }
};

}  // namespace eddy
