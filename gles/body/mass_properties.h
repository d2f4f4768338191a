#pragma once
#include <glm/glm.hpp>

#include "gles/fluid/setup.h"

namespace eddy::gles {

/// What a solid of density 1 weighs and how it resists being spun, in the frame of its body.
struct MassProperties {
    double volume_m3 = 0.0;
    glm::dvec3 centre_m{0.0};    ///< centre of mass
    glm::dmat3 inertia_m5{0.0};  ///< about the centre of mass; times a density [kg/m^3] it is in kg m^2
};

/// Adds up the parts of a solid: their volumes, and the integrals of x and of x x^T about the origin. A part
/// that is cut out of the others counts with a negative volume.
struct Moments {
    double volume = 0.0;
    glm::dvec3 first{0.0};
    glm::dmat3 second{0.0};

    Moments& operator+=(const Moments& part);
    /// The same solid moved by `d`.
    Moments moved(const glm::dvec3& d) const;
    MassProperties about_centre() const;
};

/// Exact for every shape; for a mesh, of its triangles. A shape turned inside out counts as the shape.
MassProperties mass_properties(const Shape& shape);

}  // namespace eddy::gles
