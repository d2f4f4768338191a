#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using ThinPlate = GlTest;

/// What flows through a duct that a plate 0.3 cells thick blocks, as a share of what would flow without it: the fluid falls
/// along the duct, from one opening to the other.
double leak(Gpu& gpu, const glm::dvec3& centre, double tilt_deg) {
    FluidSetup s = unit_tank({24, 16, 17}, 0.0, Advection::SemiLagrangian, 8);
    s.walls[0].kind = s.walls[1].kind = WallKind::Open;
    s.acceleration_m_s2 = VectorFormula{{"1.0", "0.0", "0.0"}};
    s.bodies.push_back({Cuboid{{0.3, 80.0, 80.0}}});
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const BodyState plate{
        .centre_m = centre,
        .orientation = glm::angleAxis(glm::radians(tilt_deg), glm::normalize(glm::dvec3(0.0, 1.0, 1.0)))};
    constexpr int kSteps = 6;
    constexpr double kDt = 0.01;
    for (int i = 0; i < kSteps; ++i) fluid->step(kDt, {plate}, false);
    const std::vector<glm::vec3> u = fluid->velocity();
    double flow = 0.0;
    for (int z = 0; z < s.cells.z; ++z)
        for (int y = 0; y < s.cells.y; ++y)
            flow += u[static_cast<std::size_t>((z * (s.cells.y + 1) + y) * (s.cells.x + 1) + 2)].x;
    return flow / (s.cells.y * s.cells.z * kSteps * kDt);
}

TEST_F(ThinPlate, LeaksLessThanAPercentWhereverItStandsAndHoweverItIsTilted) {
    for (const double tilt_deg : {0.0, 20.0, 45.0})
        for (const double offset : {0.0, 0.2, 0.5}) {
            const double share = leak(gpu, {12.0 + offset, 8.0 + 0.3 * offset, 8.5}, tilt_deg);
            record(tilt_deg == 0.0 ? "upright" : "tilted", share);
            EXPECT_NEAR(share, 0.0, 0.01) << tilt_deg << " degrees, offset " << offset;
        }
}

}  // namespace
}  // namespace eddy::gles
