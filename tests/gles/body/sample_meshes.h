#pragma once
#include "gles/body/mesh.h"

namespace eddy::gles {

/// A ball as 20 * 4^times triangles, corners on the sphere around `centre`.
TriangleMesh icosphere(double radius, int times, const glm::dvec3& centre = glm::dvec3(0.0));
/// A box between two corners, as twelve triangles.
TriangleMesh box_mesh(const glm::dvec3& low, const glm::dvec3& high);
/// The bytes of its files, coordinates as floats.
std::string binary_stl(const TriangleMesh& mesh);
std::string text_stl(const TriangleMesh& mesh);
std::string obj(const TriangleMesh& mesh);

}  // namespace eddy::gles
