#include "gles/fluid/walls.h"

#include <fmt/format.h>

#include <algorithm>

namespace eddy::gles {
namespace {

bool sticks(const WallSetup& wall) {
    return wall.kind == WallKind::NoSlip || wall.kind == WallKind::Inflow;
}

bool lets_through(const WallSetup& wall) {
    return wall.kind == WallKind::Inflow || wall.kind == WallKind::Open;
}

std::string constant(const char* name, const glm::vec3& v) {
    return fmt::format("const vec3 {} = vec3({:.8f}, {:.8f}, {:.8f});\n", name, v.x, v.y, v.z);
}

}  // namespace

const char* const kWhereFinite =
    "vec3 where_finite(vec3 v) {\n"
    "    uvec3 most = uvec3(0x7f800000u);\n"
    "    return mix(v, vec3(0.0), equal(floatBitsToUint(v) & most, most));\n}\n";

std::string formula_variables(double cell_m, const char* time) {
    return fmt::format(
        "    float x = {0:.9e} * cells.x, y = {0:.9e} * cells.y, z = {0:.9e} * cells.z, t = {1};\n", cell_m,
        time);
}

bool Walls::let_through() const {
    return std::any_of(setup_->walls.begin(), setup_->walls.end(), lets_through);
}

bool Walls::rub() const {
    return std::any_of(setup_->walls.begin(), setup_->walls.end(), sticks);
}

void Walls::declare(Variant& variant, const glm::vec3& covered) const {
    if (!let_through() && !rub()) return;
    if (let_through()) variant.defines.emplace_back("THROUGH", "");
    if (rub()) variant.defines.emplace_back("FRICTION", "");

    // A wall is half a cell from the centres of the cells beside it; on a coarse grid it may cut the last one.
    const glm::vec3 beyond = covered - 0.5f;  // how far behind that one's centre
    const glm::vec3 nearness = 1.0f / glm::max(beyond, glm::vec3(0.25f));
    // An opening at or before that centre holds it at 0, and the link to it is as long as the way to the opening: a little
    // too long a way, on the coarsest grids, and odd numbers of cycles make the pressure grow from step to step.
    const glm::vec3 pinned = 1.0f / glm::max(beyond, glm::vec3(1e-3f));
    glm::vec3 last_link(1.0f);
    glm::vec3 friction[2], open[2], inflow[2];
    std::string velocity;
    for (int wall = 0; wall < 6; ++wall) {
        const WallSetup& w = setup_->walls[static_cast<std::size_t>(wall)];
        const int axis = wall / 2, high = wall % 2;
        const float weight = high ? nearness[axis] : 2.0f;
        friction[high][axis] = sticks(w) ? weight : 0.0f;
        open[high][axis] = w.kind != WallKind::Open ? 0.0f : high ? pinned[axis] : 2.0f;
        if (high && w.kind == WallKind::Open && beyond[axis] < 0.0f)
            last_link[axis] = 1.0f / (1.0f + beyond[axis]);
        inflow[high][axis] = w.kind == WallKind::Inflow ? 1.0f : 0.0f;
        if (!sticks(w)) continue;
        const auto& f = w.velocity_m_s.glsl;
        velocity += fmt::format("    if (wall == {}) return where_finite(vec3({}, {}, {}));\n", wall, f[0],
                                f[1], f[2]);
    }
    if (last_link != glm::vec3(1.0f))
        variant.defines.emplace_back(
            "LAST_LINK", fmt::format("vec3({:.8f}, {:.8f}, {:.8f})", last_link.x, last_link.y, last_link.z));
    variant.declarations += setup_->formula_helpers;
    variant.declarations += kWhereFinite;  // guard formula
    variant.declarations += constant("FRICTION_LOW", friction[0]) + constant("FRICTION_HIGH", friction[1]) +
                            constant("OPEN_LOW", open[0]) + constant("OPEN_HIGH", open[1]) +
                            constant("INFLOW_LOW", inflow[0]) + constant("INFLOW_HIGH", inflow[1]);
    variant.declarations += fmt::format(
        "uniform float wall_time;  // [s]\n"
        "vec3 wall_velocity(int wall, vec3 place) {{\n"
        "    vec3 most = vec3({2}.0, {3}.0, {4}.0), cells = clamp(place, vec3(0.0), most);\n"
        "    cells[wall / 2] = wall % 2 == 0 ? 0.0 : most[wall / 2];\n"
        "{0}{1}    return vec3(0.0);\n}}\n",
        formula_variables(setup_->cell_m, "wall_time"), velocity, setup_->cells.x, setup_->cells.y,
        setup_->cells.z);
}

}  // namespace eddy::gles
