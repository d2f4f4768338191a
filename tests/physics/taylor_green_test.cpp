#include <cmath>
#include <numbers>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using TaylorGreen = GlTest;

/// Validation case A1 without viscosity, where nothing but the transport is at work: u = U sin kx cos ky, v = -U cos kx sin ky in a slip box is a steady
/// solution of the Euler equations, so whatever changes is error. Returns the L2 error of the velocity,
/// relative to U rms, after the fluid has travelled one length at Courant number 0.5.
double error(Gpu& gpu, int n, Advection advection) {
    const glm::ivec3 cells(n, n, 4);
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, unit_tank(cells, 0.0, advection, 6));
    const double k = std::numbers::pi / n;
    std::vector<glm::vec3> exact;
    for (int z = 0; z <= cells.z; ++z)
        for (int y = 0; y <= cells.y; ++y)
            for (int x = 0; x <= cells.x; ++x) {
                // Each component sits on its face; the layers at the upper walls repeat their neighbours.
                const glm::dvec3 low(x, y, z), middle = glm::min(low + 0.5, glm::dvec3(cells) - 0.5);
                exact.emplace_back(std::sin(k * low.x) * std::cos(k * middle.y),
                                   -std::cos(k * middle.x) * std::sin(k * low.y), 0.0);
            }
    fluid->set_velocity(exact);
    const int steps = 2 * n;
    for (int step = 0; step < steps; ++step) fluid->step(0.5, {}, false);
    const std::vector<glm::vec3> got = fluid->velocity();
    double difference = 0.0, size = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        difference += glm::dot(glm::dvec3(got[i] - exact[i]), glm::dvec3(got[i] - exact[i]));
        size += glm::dot(glm::dvec3(exact[i]), glm::dvec3(exact[i]));
    }
    return std::sqrt(difference / size);
}

TEST_F(TaylorGreen, SemiLagrangianConvergesAtFirstOrder) {
    // Measured when the limits were set: 0.237 at 16, 0.134 at 32.
    const double coarse = error(gpu, 16, Advection::SemiLagrangian),
                 fine = error(gpu, 32, Advection::SemiLagrangian);
    record("error_16", coarse);
    record("error_32", fine);
    EXPECT_LT(fine, 0.17);
    EXPECT_GT(std::log2(coarse / fine), 0.75);
}

TEST_F(TaylorGreen, MacCormackIsSeveralTimesMoreAccurateAndConverges) {
    const double coarse = error(gpu, 16, Advection::MacCormack), fine = error(gpu, 32, Advection::MacCormack);
    record("error_16", coarse);
    record("error_32", fine);
    EXPECT_LT(fine, 0.05);  // measured when the limits were set: 0.068 at 16, 0.037 at 32
    EXPECT_GT(std::log2(coarse / fine), 0.8);
    EXPECT_LT(fine, 0.4 * error(gpu, 32, Advection::SemiLagrangian));
}

}  // namespace
}  // namespace eddy::gles
