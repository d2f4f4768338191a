#include "gles/body/distance_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gles/body/bounds.h"
#include "gles/body/triangle_tree.h"
#include "tests/gles/body/sample_meshes.h"
#include "tests/gles/body/shape_reference.h"

namespace eddy::gles {
namespace {

TEST(TriangleTree, FindsTheExactDistanceToABoxAndToATetrahedron) {
    Random random(4);
    const Cuboid cuboid{{2.0, 1.0, 3.0}};
    const TriangleTree box(box_mesh(-0.5 * cuboid.size_m, 0.5 * cuboid.size_m));
    const Tetrahedron tetrahedron{2.0};
    TriangleMesh mesh;
    for (const glm::dvec3& corner : corners_m(tetrahedron)) mesh.corners.push_back(corner);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    const TriangleTree pyramid(mesh);
    std::uint32_t near = 0, near_too = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 x = random_point(random, -3.0, 3.0);
        ASSERT_NEAR(box.signed_distance(x, near), exact_distance(cuboid, x), 1e-12);
        ASSERT_NEAR(pyramid.signed_distance(x, near_too), exact_distance(tetrahedron, x), 1e-12);
    }
}

// A blade with a sharp edge, seen from beyond it: the normal of either face alone would give the wrong side.
TEST(TriangleTree, KnowsTheSideBeyondSharpEdges) {
    TriangleMesh wedge;
    wedge.corners = {{0, 0, 0}, {5, 0.02, 0}, {5, -0.02, 0}, {0, 0, 3}, {5, 0.02, 3}, {5, -0.02, 3}};
    wedge.triangles = {{0, 4, 1}, {0, 3, 4}, {0, 5, 3}, {0, 2, 5},
                       {1, 5, 2}, {1, 4, 5}, {0, 1, 2}, {3, 5, 4}};
    ASSERT_GT(mass_properties(wedge).volume_m3, 0.0);
    const TriangleTree tree(wedge);
    Random random(5);
    std::uint32_t near = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 x = random_point(random, -1.0, 4.0);
        const bool inside = x.x > 0.0 && x.x < 5.0 && std::abs(x.y) < 0.004 * x.x && x.z > 0.0 && x.z < 3.0;
        ASSERT_EQ(tree.signed_distance(x, near) < 0.0, inside) << x.x << " " << x.y << " " << x.z;
    }
}

TEST(TriangleTree, FindsTheSameWhereverItBeginsToLook) {
    const TriangleTree tree(icosphere(1.0, 3, glm::dvec3(0.2)));
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 x = random_point(random, -2.0, 2.0);
        std::uint32_t near = 0, other = static_cast<std::uint32_t>(random() % 1280);
        ASSERT_EQ(tree.signed_distance(x, near), tree.signed_distance(x, other));
    }
}

TEST(DistanceGrid, OfABallIsTheBallsDistance) {
    const double radius = 2.0;
    const glm::dvec3 centre(1.0, -0.5, 0.3);
    const TriangleMesh ball = icosphere(radius, 4, centre);  // 5120 triangles
    const DistanceGrid grid(ball, 64, 0.5);

    // Triangles with edges of 0.08 R lie up to 0.0011 R inside the sphere. Linear between nodes, the distance
    // R + d from a point comes out up to h^2 / 4 (R + d) too large (h^2 / 8 for each of its two curvatures).
    const double h = grid.spacing_m();
    Random random(7);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 x = centre + random_point(random, -2.4, 2.4);
        const double exact = glm::length(x - centre) - radius;
        if (exact < -0.5 * radius) continue;
        const double bound = 0.0011 * radius + h * h / (4.0 * (radius + exact));
        worst = std::max(worst, std::abs(grid.at(x) - exact) / bound);
    }
    EXPECT_LT(worst, 1.1);
    EXPECT_GT(worst, 0.5);
    EXPECT_EQ(grid.nodes(), glm::ivec3(64));
    EXPECT_NEAR(grid.radius_m(), glm::length(centre) + radius, 0.003);
}

TEST(DistanceGrid, OutsideItsBoxIsNeverMoreThanTheTrueDistanceAndHasNoStepThere) {
    const double radius = 2.0;
    const DistanceGrid grid(icosphere(radius, 4), 32);
    const double h = grid.spacing_m();
    Random random(8);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 x = random_point(random, -12.0, 12.0);
        const double exact = glm::length(x) - radius;
        if (exact < -0.5 * radius) continue;  // its middle has no one nearest point
        ASSERT_LT(grid.at(x), exact + 0.02 * h + 0.01);
        if (exact > 0.0) {
            ASSERT_GT(grid.at(x), 0.5 * exact);
        }
    }
    const glm::dvec3 high = grid.low_m() + h * glm::dvec3(grid.nodes() - 1);
    EXPECT_NEAR(grid.at({high.x - 1e-6, 0.3, 0.4}), grid.at({high.x + 1e-6, 0.3, 0.4}), 1e-5);
    EXPECT_NEAR(grid.at({high.x - 1e-6, high.y - 1e-6, 0.4}), grid.at({high.x + 1e-6, high.y + 1e-6, 0.4}),
                1e-5);
}

TEST(DistanceGrid, LeavesThePaddingAskedForAndAtLeastTwoSpacings) {
    const TriangleMesh box = box_mesh({-1.0, -0.1, -0.5}, {2.0, 0.1, 0.5});
    for (const double padding : {0.0, 0.5, 3.0}) {
        const DistanceGrid grid(box, 48, padding);
        const double least = std::max(padding, 2.0 * grid.spacing_m()) - 1e-9;
        const glm::dvec3 high = grid.low_m() + grid.spacing_m() * glm::dvec3(grid.nodes() - 1);
        EXPECT_TRUE(glm::all(glm::lessThanEqual(grid.low_m(), grid.mesh_low_m() - least)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(high, grid.mesh_high_m() + least)));
        EXPECT_EQ(grid.nodes().x, 48);
        EXPECT_LT(grid.nodes().y, 48);
    }
}

// Flat faces come out exactly, whatever the spacing, away from edges.
TEST(DistanceGrid, OfABoxIsExactOverItsFaces) {
    const DistanceGrid grid(box_mesh({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}), 20);
    for (const double y : {-0.3, 0.0, 0.41})
        for (const double x : {0.7, 0.9, 1.0, 1.1, 1.2})
            EXPECT_NEAR(grid.at({x, y, 0.123}), x - 1.0, 1e-6) << x << " " << y;
}

}  // namespace
}  // namespace eddy::gles
