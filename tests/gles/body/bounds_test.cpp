#include "gles/body/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "gles/body/distance_grid.h"
#include "tests/gles/body/sample_meshes.h"
#include "tests/gles/body/shape_reference.h"

namespace eddy::gles {
namespace {

/// Where rays from the body's centre leave it; for a torus, from its ring.
std::vector<glm::dvec3> surface_points(const Shape& shape, Random& random) {
    std::vector<glm::dvec3> points;
    while (points.size() < 30000) {
        const glm::dvec3 direction = random_point(random, -1.0, 1.0);
        glm::dvec3 from(0.0);
        if (const Torus* torus = std::get_if<Torus>(&shape)) {
            const glm::dvec3 other = random_point(random, -1.0, 1.0);
            from = torus->radius_m * glm::normalize(glm::dvec3(other.x, 0.0, other.z));
        }
        double low = 0.0, high = 100.0;
        for (int i = 0; i < 50; ++i) {
            const double t = 0.5 * (low + high);
            (is_inside(shape, from + t * direction) ? low : high) = t;
        }
        points.push_back(from + low * direction);
    }
    return points;
}

std::vector<NamedShape> all_shapes() {
    std::vector<NamedShape> shapes = closed_form_shapes();
    shapes.push_back(
        {"mesh", Mesh{std::make_shared<DistanceGrid>(box_mesh({-2.0, -1.0, -3.0}, {5.0, 1.5, 2.0}), 12)}});
    return shapes;
}

/// Points all over a shape's surface, in its frame.
std::vector<glm::dvec3> points_of(const NamedShape& named, Random& random) {
    if (named.name == "mesh") return box_mesh({-2.0, -1.0, -3.0}, {5.0, 1.5, 2.0}).corners;
    return surface_points(named.shape, random);
}

TEST(Bounds, LeaveABodyRoomUpToTheWallsOrPutItInTheMiddle) {
    const Extent lopsided{{-1.0, -2.0, -9.0}, {3.0, 2.0, 4.0}};
    const Extent room = room_for_centre(lopsided, glm::dvec3(10.0), 0.5);
    EXPECT_EQ(room.low, glm::dvec3(1.5, 2.5, 7.5));
    EXPECT_EQ(room.high, glm::dvec3(6.5, 7.5, 7.5));
}

TEST(Bounds, OfAMeshAsABallDoNotHangOnWhereItsOriginIs) {
    const glm::dvec3 low(-2.0, -1.0, -3.0), high(5.0, 1.5, 2.0), origin(3.0, -7.0, 2.0);
    const auto ball = [&](const glm::dvec3& shift) {
        return bounding_ball(Mesh{std::make_shared<DistanceGrid>(box_mesh(low - shift, high - shift), 12)});
    };
    const Ball here = ball(glm::dvec3(0.0)), there = ball(origin);
    EXPECT_NEAR(there.radius_m, here.radius_m, 1e-12);
    EXPECT_LT(glm::length(there.centre_m + origin - here.centre_m), 1e-12);
    for (const glm::dvec3& x : box_mesh(low, high).corners)
        EXPECT_LE(glm::distance(x, here.centre_m), here.radius_m + 1e-12);
}

TEST(Bounds, HoldTheShapeTightlyInEveryPose) {
    Random random(2);
    for (const NamedShape& named : all_shapes()) {
        const std::vector<glm::dvec3> points = points_of(named, random);
        double radius = 0.0;
        for (const glm::dvec3& x : points) radius = std::max(radius, glm::length(x));
        EXPECT_LE(radius, bounding_radius_m(named.shape) + 1e-9) << named.name;
        EXPECT_GT(radius, 0.95 * bounding_radius_m(named.shape)) << named.name;
        for (int pose = 0; pose < 10; ++pose) {
            // Also not of unit length, as an integrator may leave it.
            const glm::dquat turn = random_turn(random) * 1.01;
            glm::dvec3 low(1e9), high(-1e9);
            for (const glm::dvec3& x : points) {
                const glm::dvec3 turned = glm::mat3_cast(glm::normalize(turn)) * x;
                low = glm::min(low, turned);
                high = glm::max(high, turned);
            }
            const Extent e = extent(named.shape, turn);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(low[axis], e.low[axis] - 1e-9) << named.name;
                EXPECT_LE(high[axis], e.high[axis] + 1e-9) << named.name;
                EXPECT_LT(low[axis], e.low[axis] + 0.25) << named.name;
                EXPECT_GT(high[axis], e.high[axis] - 0.25) << named.name;
            }
        }
    }
}

TEST(Bounds, BodyBoxHasTwoCellsAroundTheBodyInsideTheGrid) {
    BodyState state;
    state.centre_m = {0.55, 0.30, 0.08};
    const Box box = body_box({Sphere{0.1}}, state, 0.02, {40, 40, 40});
    EXPECT_EQ(box, (Box{{20, 8, 0}, {35, 22, 11}}));
    // On its side, a rod is as long in x as it was in y.
    state.orientation = glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(0.0, 0.0, 1.0));
    state.centre_m = glm::dvec3(0.41);
    EXPECT_EQ(body_box({Capsule{0.01, 0.2}}, state, 0.02, {40, 40, 40}), (Box{{13, 18, 18}, {28, 23, 23}}));
}

TEST(Bounds, BodyBoxOfAContainerIsTheWholeGrid) {
    const BodySetup container{.shape = Sphere{0.1}, .inside_out = true};
    BodyState state;
    state.centre_m = glm::dvec3(0.4);
    const glm::ivec3 cells(40, 30, 20);
    EXPECT_EQ(body_box(container, state, 0.02, cells), (Box{{0, 0, 0}, cells}));
    EXPECT_EQ(largest_body_box(container, 0.02, cells), cells);
    EXPECT_NE(body_box({container.shape}, state, 0.02, cells), (Box{{0, 0, 0}, cells}));
}

TEST(Bounds, NoBodyBoxIsLargerThanTheLargest) {
    Random random(3);
    const glm::ivec3 cells(60, 60, 60);
    std::vector<NamedShape> shapes = all_shapes();
    shapes.push_back(
        {"round mesh", Mesh{std::make_shared<DistanceGrid>(icosphere(3.0, 2, glm::dvec3(0.0)), 12)}});
    for (const NamedShape& named : shapes) {
        const glm::ivec3 largest = largest_body_box({named.shape}, 0.4, cells);
        for (int pose = 0; pose < 200; ++pose) {
            BodyState state;
            state.centre_m = random_point(random, 0.0, 24.0);
            state.orientation = random_turn(random);
            const Box box = body_box({named.shape}, state, 0.4, cells);
            EXPECT_TRUE(glm::all(glm::lessThanEqual(box.hi - box.lo, largest))) << named.name;
        }
    }
}

}  // namespace
}  // namespace eddy::gles
