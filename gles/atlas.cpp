#include "gles/atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy::gles {

AtlasLayout AtlasLayout::tile(const glm::ivec3& size) {
    const double square = std::sqrt(static_cast<double>(size.z) * size.y / size.x);
    AtlasLayout layout{size, std::max(1, static_cast<int>(std::lround(square)))};
    layout.tiles_x = std::min(layout.tiles_x, size.z);
    // No more columns than the rows need: 5 slabs in rows of 4 and 1 fit rows of 3 and 2 as well.
    layout.tiles_x = (size.z + layout.tiles_y() - 1) / layout.tiles_y();
    return layout;
}

std::string AtlasLayout::declaration(const std::string& name) const {
    const glm::ivec2 t = texels();
    return fmt::format("const Layout {} = Layout(ivec3({}, {}, {}), {}, vec2(1.0 / {}.0, 1.0 / {}.0));\n",
                       name, size.x, size.y, size.z, tiles_x, t.x, t.y);
}

}  // namespace eddy::gles
