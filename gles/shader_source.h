#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cmake/embedded.h"

namespace eddy::gles {

/// A shader with its #include lines expanded, ready to compile. Every part keeps its own file and line.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  ///< file number used in #line -> path from the top of the tree

    /// The driver's log with its file numbers ("0:12(5): error", "0(12) : error", "ERROR: 0:12:") turned into
    /// paths.
    std::string locate(std::string_view log) const;
};

/// Reads an embedded shader ("gles/fluid/advect.frag") and expands each `#include "file"` (from the same
/// folder, or else from gles/) once. In front of it: `#version 300 es`, the precisions, `switches`
/// (#defines), gles/atlas.glsl and `declarations` (constants and functions). Throws GlError with file and
/// line when an include is missing.
ShaderSource load_shader(std::string_view path, std::string_view switches, std::string_view declarations);

/// The same for a shader that is not among the embedded ones; its includes are.
ShaderSource expand_shader(const EmbeddedFile& file, std::string_view switches,
                           std::string_view declarations);

/// Texture fetches for one texel written, as the shader's header says: "// fetches 8, CUT 14, CUT+WALLS 24" is
/// a number for the plain shader and one for each combination of switches that changes it; the last whose
/// switches are all among `defined` counts.
int declared_fetches(std::string_view path, const std::vector<std::string>& defined = {});

}  // namespace eddy::gles
