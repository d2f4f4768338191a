#include <fmt/format.h>

#include <cmath>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/scene_parts.h"
#include "gles/body/distance_grid.h"
#include "gles/fluid/face_shares.h"

namespace eddy::stability {
namespace {

/// 33: an orientation that is none.
Case crooked(const char* name, const char* title, glm::dquat orientation) {
    return {.number = 33,
            .name = name,
            .title = title,
            .provokes = "a distance that is none: normals that are not, areas that are wrong",
            .drive = Drive::Steps,
            .change =
                [](Scene& s) {
                    const double side = shortest_side_m(s);
                    ball(s).shape = BodyShape::Box;
                    ball(s).size_m = glm::dvec3(0.4, 0.3, 0.2) * side;
                },
            .bodies =
                [orientation](const Moment& m, std::vector<gles::BodyState>& bodies) {
                    if (m.disturbs() && !bodies.empty()) bodies[0].orientation = orientation;
                }};
}

/// Adds a box to a mesh, as a surface of its own.
void add_box(gles::TriangleMesh& mesh, const glm::dvec3& size_m) {
    const auto first = static_cast<glm::uint>(mesh.corners.size());
    for (int corner = 0; corner < 8; ++corner)
        mesh.corners.push_back(size_m * (glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1) - 0.5));
    // Counter-clockwise from outside: x low, x high, y low, y high, z low, z high.
    for (const glm::uvec4& side : {glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5), glm::uvec4(0, 1, 5, 4),
                                   glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6)}) {
        mesh.triangles.emplace_back(first + side.x, first + side.y, first + side.z);
        mesh.triangles.emplace_back(first + side.x, first + side.z, first + side.w);
    }
}

/// The surface that the solver sees, from the fluid's shares of faces [m2].
double surface_m2(gles::Gpu& gpu, const gles::Fluid& fluid, const Fields&, double) {
    const gles::OnFaces shares = gles::face_shares(gpu, fluid.setup(), fluid.bodies());
    double cells = 0.0;
    // Where the shares of walls, which are 0, do not come in.
    for (int z = 1; z + 1 < shares.cells.z; ++z)
        for (int y = 1; y + 1 < shares.cells.y; ++y)
            for (int x = 1; x + 1 < shares.cells.x; ++x) {
                glm::dvec3 out(0.0);
                for (int k = 0; k < 3; ++k) {
                    glm::ivec3 above(x, y, z);
                    ++above[k];
                    out[k] =
                        shares.values[shares.index(above)][k] - shares.values[shares.index({x, y, z})][k];
                }
                cells += glm::length(out);
            }
    return cells * fluid.setup().cell_m * fluid.setup().cell_m;
}

/// 33: a solid whose distance is none. `area`: of its surface, in shortest sides of the tank, squared.
Case wrong_distance(const char* name, const char* title, double area,
                    std::function<gles::DistanceGrid(double side_m, double cell_m)> distance) {
    return {.number = 33,
            .name = name,
            .title = title,
            .provokes = "shares of cells that are none, a stress on the wrong area",
            .drive = Drive::Steps,
            // Turned, so that no surface goes with the cells.
            .change =
                [](Scene& s) {
                    ball(s).axis = {1.0, 2.0, 3.0};
                    ball(s).angle_deg = 40.0;
                },
            .solids =
                [distance](gles::FluidSetup& setup) {
                    const glm::ivec3& n = setup.cells;
                    if (setup.bodies.empty()) return;
                    setup.bodies[0].shape = gles::Mesh{std::make_shared<gles::DistanceGrid>(
                        distance(setup.cell_m * std::min({n.x, n.y, n.z}), setup.cell_m))};
                },
            .measure = surface_m2,
            .remark =
                [area](const History& history) {
                    if (history.looks.empty()) return std::string();
                    const glm::ivec3& n = history.tank.cells;
                    const double side_m = history.tank.cell_m * std::min({n.x, n.y, n.z});
                    return fmt::format(
                        "its surface is off by {:.0f} %",
                        100.0 * (history.looks.front().measured / (area * side_m * side_m) - 1.0));
                }};
}

/// A cube of 0.3 sides whose distances are so many times too large.
Case scaled_distance(const char* name, const char* title, double times) {
    return wrong_distance(name, title, 6.0 * 0.3 * 0.3, [times](double side_m, double cell_m) {
        gles::TriangleMesh mesh;
        add_box(mesh, glm::dvec3(0.3 * side_m));
        return gles::DistanceGrid(mesh, 32, 2.0 * cell_m).scaled(times);
    });
}

}  // namespace

std::vector<Case> distance_cases() {
    std::vector<Case> cases;
    cases.push_back(
        crooked("long-quaternion", "the box has an orientation of length 3", {3.0, 0.0, 0.0, 0.0}));
    cases.push_back(crooked("no-quaternion", "the box has an orientation of length 0", {0.0, 0.0, 0.0, 0.0}));
    cases.push_back({.number = 33,
                     .name = "needle",
                     .title = "an ellipsoid twenty times as long as thick",
                     .provokes = "a distance that is off by the order of itself",
                     .change = [](Scene& s) {
                         const double side = shortest_side_m(s);
                         ball(s).shape = BodyShape::Ellipsoid;
                         ball(s).radii_m = glm::dvec3(0.3, 0.015, 0.3) * side;
                     }});
    cases.push_back(
        scaled_distance("distance-tenfold", "a cube whose distances are ten times too large", 10.0));
    cases.push_back(
        scaled_distance("distance-tenth", "a cube whose distances are a tenth of what they are", 0.1));
    // Together a cross with arms of 0.4 by 0.2 by 0.2: around it 1.6 by 0.2, and its two sides of 0.12 each.
    cases.push_back(wrong_distance("self-crossing", "two boxes that go through each other in one mesh", 0.56,
                                   [](double side_m, double cell_m) {
                                       gles::TriangleMesh mesh;
                                       add_box(mesh, glm::dvec3(0.4, 0.2, 0.2) * side_m);
                                       add_box(mesh, glm::dvec3(0.2, 0.4, 0.2) * side_m);
                                       return gles::DistanceGrid(mesh, 32, 2.0 * cell_m);
                                   }));
    return cases;
}

}  // namespace eddy::stability
