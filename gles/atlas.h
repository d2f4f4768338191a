#pragma once
#include <glm/glm.hpp>
#include <string>

namespace eddy::gles {

/// How a 3D grid is laid out in a 2D texture: `size.z` slabs of `size.x` x `size.y` texels, side by side in
/// rows of `tiles_x`. A texel's index (x, y, slab) is what shaders call a cell of that layout. The same in
/// gles/atlas.glsl.
struct AtlasLayout {
    glm::ivec3 size{0};  ///< texels in x and y of one slab, number of slabs
    int tiles_x = 1;     ///< slabs in one row

    int tiles_y() const { return (size.z + tiles_x - 1) / tiles_x; }
    glm::ivec2 texels() const { return {size.x * tiles_x, size.y * tiles_y()}; }
    /// Texel that holds index (x, y, slab).
    glm::ivec2 texel(const glm::ivec3& c) const {
        return {(c.z % tiles_x) * size.x + c.x, (c.z / tiles_x) * size.y + c.y};
    }
    bool operator==(const AtlasLayout&) const = default;

    /// The layout with the squarest texture, so that thin or long grids stay far from the texture size limit.
    static AtlasLayout tile(const glm::ivec3& size);
    /// `const Layout NAME = ...;` for shaders.
    std::string declaration(const std::string& name) const;
};

/// The four ways a field of n = (nx, ny, nz) cells is stored. "4" means four consecutive z share one RGBA
/// texel, so a slab holds four layers; the last slab may hold padding, which is finite but means nothing.
struct Cells {  // one texel a cell
    static AtlasLayout layout(const glm::ivec3& n) { return AtlasLayout::tile(n); }
};
struct Faces {  // one texel for the three lower faces of a cell; one layer more each way for the upper walls
    static AtlasLayout layout(const glm::ivec3& n) { return AtlasLayout::tile(n + 1); }
};
struct Cells4 {
    static AtlasLayout layout(const glm::ivec3& n) { return AtlasLayout::tile({n.x, n.y, (n.z + 3) / 4}); }
};
struct Faces4 {
    static AtlasLayout layout(const glm::ivec3& n) {
        return AtlasLayout::tile({n.x + 1, n.y + 1, (n.z + 4) / 4});
    }
};

/// A half-open box of cells, lo <= c < hi.
struct Box {
    glm::ivec3 lo{0}, hi{0};
    bool empty() const { return hi.x <= lo.x || hi.y <= lo.y || hi.z <= lo.z; }
    Box intersect(const Box& b) const { return {glm::max(lo, b.lo), glm::min(hi, b.hi)}; }
    Box grow(int cells) const { return {lo - cells, hi + cells}; }
    /// Faces of these cells: one layer more at the upper sides.
    Box faces() const { return {lo, hi + 1}; }
    /// The cells of the next coarser grid that hold any of these.
    Box coarsen() const { return {lo / 2, (hi + 1) / 2}; }
    bool operator==(const Box&) const = default;
};

}  // namespace eddy::gles
