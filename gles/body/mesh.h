#pragma once
#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "gles/body/mass_properties.h"

namespace eddy::gles {

/// A mesh that cannot be used. One line: file and line (or byte), what is wrong, what to do.
struct MeshError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A closed surface: each edge belongs to two triangles that run along it in opposite directions. Corners are
/// counter-clockwise seen from outside; no triangle uses a corner twice.
struct TriangleMesh {
    std::vector<glm::dvec3> corners;    ///< [m], each place once
    std::vector<glm::uvec3> triangles;  ///< numbers of their corners
};

/// Triangles as a file lists them, and where each was read.
struct TriangleSoup {
    std::string name;                 ///< of the file
    bool counts_lines = true;         ///< `places` are lines, or else bytes
    std::vector<glm::dvec3> corners;  ///< three a triangle, in the file's unit
    std::vector<std::size_t> places;

    /// Throws MeshError when there are too many.
    void add(const std::array<glm::dvec3, 3>& triangle, std::size_t place);
    /// Throws MeshError.
    [[noreturn]] void refuse(std::size_t place, const std::string& why) const;
};

/// Joins triangles whose corners meet. One unit of the soup is `scale_m`. A surface that is inside out as a
/// whole is turned. Throws MeshError if it is not closed, or encloses nothing.
TriangleMesh closed_mesh(TriangleSoup soup, double scale_m);

/// Exact for the solid that these triangles enclose.
MassProperties mass_properties(const TriangleMesh& mesh);

}  // namespace eddy::gles
