#include "gles/render/camera.h"

#include <gtest/gtest.h>

namespace eddy::gles {
namespace {

constexpr double kRounding = 1e-12;

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::distance(a, b), kRounding);
}

TEST(Camera, StandsWhereItsAnglesSay) {
    const glm::dvec3 tank(0.16);
    const double far = 2.0 * glm::length(tank);
    expect_near(Camera{0.0, 0.0, 2.0}.eye(tank), glm::dvec3(0.08, 0.08, 0.08 + far));
    expect_near(Camera{90.0, 0.0, 2.0}.eye(tank), glm::dvec3(0.08 + far, 0.08, 0.08));
    expect_near(Camera{0.0, 90.0, 2.0}.eye(tank), glm::dvec3(0.08, 0.08 + far, 0.08));
}

TEST(Camera, LooksAtTheMiddleAndIsNeverTilted) {
    for (double azimuth : {-170.0, -20.0, 0.0, 45.0, 90.0})
        for (double elevation : {-90.0, -30.0, 0.0, 60.0, 90.0}) {
            const Camera camera{azimuth, elevation, 1.5};
            expect_near(camera.rays(1.0) * glm::dvec3(0.0, 0.0, 1.0), -camera.backward());
            EXPECT_NEAR(camera.right().y, 0.0, kRounding);
            EXPECT_GE(camera.up().y, -kRounding);
            EXPECT_NEAR(glm::length(camera.up()), 1.0, kRounding);
        }
}

TEST(Camera, FitsTheWholeTankIntoWideAndTallPictures) {
    for (double aspect : {640.0 / 480.0, 1.0, 9.0 / 16.0})
        for (double azimuth : {0.0, 20.0, 45.0}) {
            const Camera camera{azimuth, 15.0, 1.5};
            const glm::dvec3 tank(0.16);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 p(0.16 * (corner & 1), 0.16 * (corner >> 1 & 1), 0.16 * (corner >> 2 & 1));
                const glm::dvec3 seen = glm::inverse(camera.rays(aspect)) * (p - camera.eye(tank));
                EXPECT_LT(std::abs(seen.x / seen.z), 1.0);
                EXPECT_LT(std::abs(seen.y / seen.z), 1.0);
            }
        }
}

}  // namespace
}  // namespace eddy::gles
