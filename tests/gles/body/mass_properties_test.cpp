#include "gles/body/mass_properties.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "gles/body/bounds.h"
#include "gles/body/distance_grid.h"
#include "tests/gles/body/sample_meshes.h"
#include "tests/gles/body/shape_reference.h"

namespace eddy::gles {
namespace {

/// The same by adding up those of a million points that lie inside, one in each box of a lattice.
MassProperties counted(const Shape& shape) {
    const Extent e = extent(shape, glm::dquat(1.0, 0.0, 0.0, 0.0));
    constexpr int kPoints = 100;
    Random random(10);
    const glm::dvec3 step = (e.high - e.low) / static_cast<double>(kPoints);
    Moments sum;
    for (int k = 0; k < kPoints; ++k)
        for (int j = 0; j < kPoints; ++j)
            for (int i = 0; i < kPoints; ++i) {
                const glm::dvec3 x = e.low + (glm::dvec3(i, j, k) + random_point(random, 0.0, 1.0)) * step;
                if (!is_inside(shape, x)) continue;
                sum.volume += 1.0;
                sum.first += x;
                sum.second += glm::outerProduct(x, x);
            }
    const double each = step.x * step.y * step.z;
    return Moments{each * sum.volume, each * sum.first, each * sum.second}.about_centre();
}

double largest(const glm::dmat3& m) {
    double most = 0.0;
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) most = std::max(most, std::abs(m[k][l]));
    return most;
}

TEST(MassProperties, AreThoseOfCountedPoints) {
    std::vector<NamedShape> shapes = closed_form_shapes();
    // Handles wider than the blade is thick, than it is broad, and thinner than both.
    shapes.push_back({"thick handle", Paddle{{4.0, 5.0, 0.8}, 1.5, 2.0}});
    shapes.push_back({"handle around the blade", Paddle{{2.0, 5.0, 1.0}, 1.4, 2.0}});
    shapes.push_back({"handle round half the blade", Paddle{{2.0, 5.0, 1.8}, 1.2, 2.0}});
    shapes.push_back({"thin handle", Paddle{{4.0, 5.0, 1.0}, 0.3, 2.0}});
    for (const auto& [name, shape] : shapes) {
        const MassProperties exact = mass_properties(shape), counts = counted(shape);
        EXPECT_NEAR(exact.volume_m3 / counts.volume_m3, 1.0, 0.001) << name;
        EXPECT_LT(glm::length(exact.centre_m - counts.centre_m), 0.003) << name;
        EXPECT_LT(largest(exact.inertia_m5 - counts.inertia_m5), 0.002 * largest(counts.inertia_m5)) << name;
    }
}

TEST(MassProperties, OfABallAndOfAnEllipsoidOfEqualRadiiAreTheSame) {
    const MassProperties ball = mass_properties(Sphere{0.3}),
                         same = mass_properties(Ellipsoid{glm::dvec3(0.3)});
    EXPECT_DOUBLE_EQ(ball.volume_m3, 4.0 / 3.0 * std::numbers::pi * 0.027);
    EXPECT_DOUBLE_EQ(ball.inertia_m5[1].y, 0.4 * ball.volume_m3 * 0.09);
    EXPECT_DOUBLE_EQ(ball.inertia_m5[1].y, same.inertia_m5[1].y);
}

// Far from the origin, so that the two ways to go wrong, no parallel axes and lost digits, both show.
TEST(MassProperties, OfAMeshOfABoxAreThoseOfTheBox) {
    const glm::dvec3 low(100.0, -3.0, 7.0), high(102.0, -2.0, 7.5);
    const MassProperties mesh = mass_properties(box_mesh(low, high)),
                         box = mass_properties(Cuboid{high - low});
    EXPECT_NEAR(mesh.volume_m3, box.volume_m3, 1e-12);
    EXPECT_LT(glm::length(mesh.centre_m - 0.5 * (low + high)), 1e-12);
    EXPECT_LT(largest(mesh.inertia_m5 - box.inertia_m5), 1e-12);
    const Mesh shape{std::make_shared<DistanceGrid>(box_mesh(low, high), 8)};
    EXPECT_EQ(mass_properties(Shape(shape)).inertia_m5, mesh.inertia_m5);
}

TEST(MassProperties, OfAMeshOfATetrahedronAreThoseOfTheTetrahedron) {
    const Tetrahedron tetrahedron{2.0};
    TriangleMesh mesh;
    for (const glm::dvec3& corner : corners_m(tetrahedron)) mesh.corners.push_back(corner);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    const MassProperties exact = mass_properties(Shape(tetrahedron)), summed = mass_properties(mesh);
    EXPECT_NEAR(summed.volume_m3, exact.volume_m3, 1e-12);
    EXPECT_LT(glm::length(summed.centre_m), 1e-12);
    EXPECT_LT(largest(summed.inertia_m5 - exact.inertia_m5), 1e-12);
}

}  // namespace
}  // namespace eddy::gles
