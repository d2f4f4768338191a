#include "firmware/accuracy/face_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/gles/gl_fixture.h"

namespace eddy::accuracy {
namespace {

constexpr double kPi = std::numbers::pi;

using FaceVelocities = gles::GlTest;

/// A tank of pi x pi x pi/2 whose fluid moves as `u` at the start.
FaceVelocity field(gles::Gpu& gpu, const VelocityFormula& u) {
    gles::FluidSetup setup;
    setup.cells = {16, 16, 8};
    setup.cell_m = kPi / 16;
    setup.velocity_at_start = u;
    return FaceVelocity(*gles::make_fluid(gpu, setup));
}

glm::dvec3 vortices(const glm::dvec3& x) {
    return {std::sin(x.x) * std::cos(x.y), -std::cos(x.x) * std::sin(x.y), 0.0};
}

TEST_F(FaceVelocities, LieOnTheFacesTheySay) {
    const FaceVelocity u =
        field(gpu, [](const glm::dvec3& x) { return glm::dvec3(x.x + 10 * x.y, x.z, x.y); });
    const double h = u.cell_m();
    EXPECT_NEAR(u.at({3, 2, 1}, 0), 3 * h + 10 * 2.5 * h, 1e-5);
    EXPECT_NEAR(u.at({3, 2, 1}, 1), 1.5 * h, 1e-6);
    EXPECT_NEAR(u.at({3, 2, 1}, 2), 2.5 * h, 1e-6);
    EXPECT_EQ(u.place_m({3, 2, 1}, 0), h * glm::dvec3(3.0, 2.5, 1.5));
}

TEST_F(FaceVelocities, OfTaylorAndGreensVorticesHaveTheirEnergyAndVorticity) {
    // sin^2 and cos^2 have the mean 1/2 on this grid exactly; differences over a cell see a wave 2 sin(h/2) / h as steep.
    const FaceVelocity u = field(gpu, vortices);
    const double steepness = 2.0 * std::sin(0.5 * u.cell_m()) / u.cell_m();
    EXPECT_NEAR(u.energy(), 0.25, 1e-6);
    EXPECT_NEAR(u.mean_square_vorticity(), steepness * steepness, 1e-6);
    EXPECT_NEAR(u.fastest_m_s(), 1.0, 0.01);
}

TEST_F(FaceVelocities, AreComparedInTheRootMeanSquare) {
    const FaceVelocity u = field(gpu, vortices);
    EXPECT_NEAR(relative_l2(u, vortices), 0.0, 1e-6);
    EXPECT_NEAR(relative_l2(u, [](const glm::dvec3& x) { return 0.8 * vortices(x); }), 0.25, 1e-6);
    EXPECT_NEAR(amplitude(u, [](const glm::dvec3& x) { return 2.0 * vortices(x); }), 0.5, 1e-6);
    EXPECT_NEAR(amplitude(u, [](const glm::dvec3& x) { return vortices(2.0 * x); }), 0.0, 1e-6);
}

}  // namespace
}  // namespace eddy::accuracy
