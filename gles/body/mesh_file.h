#pragma once
#include <string>
#include <string_view>

#include "gles/body/mesh.h"

namespace eddy::gles {

/// Reads an STL (binary or text) or OBJ file, by its ending. Lengths in the file are multiplied by `scale_m`;
/// the file's origin stays the origin. Throws MeshError.
TriangleMesh read_mesh(const std::string& path, double scale_m);

/// The same for the bytes of a file that messages call `name`. Polygons of an OBJ must be convex.
TriangleMesh parse_stl(std::string_view bytes, const std::string& name, double scale_m);
TriangleMesh parse_obj(std::string_view text, const std::string& name, double scale_m);

}  // namespace eddy::gles
