#include <algorithm>
#include <cmath>

#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

// Validation cases 11 and 12: where bodies meet each other or a wall, slivers of faces are left between them. Continuity would
// have the fluid leave through them a thousand times as fast as the bodies come.

using GapsTest = GlTest;

constexpr double kGapStepS = 0.02;

FluidSetup tank() {
    FluidSetup s;
    s.cells = glm::ivec3(25);
    s.cell_m = 0.16 / 25;
    return s;
}

double fastest(Fluid& fluid, int steps, const std::function<std::vector<BodyState>(double)>& at) {
    double most = 0.0;
    for (int n = 1; n <= steps; ++n) {
        fluid.step(kGapStepS, at(n * kGapStepS), false);
        const StepResult result = fluid.wait_result();
        EXPECT_TRUE(result.is_sound());
        most = std::max(most, result.health.fastest_m_s);
    }
    return most;
}

TEST_F(GapsTest, BallsThatPassThroughEachOtherThrowNoFluidAbout) {
    constexpr double kSpeed = 0.05, kRadius = 0.024;
    FluidSetup s = tank();
    s.bodies = {BodySetup{Sphere{kRadius}}, BodySetup{Sphere{kRadius}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const double most = fastest(*fluid, 100, [](double t) {
        const auto ball = [&](double sign) {
            return BodyState{.centre_m = glm::dvec3(0.08) + sign * glm::dvec3(-0.05 + kSpeed * t, 0.006, 0.0),
                             .velocity_m_s = {sign * kSpeed, 0.0, 0.0}};
        };
        return std::vector<BodyState>{ball(1.0), ball(-1.0)};
    });
    RecordProperty("times_as_fast", std::to_string(most / kSpeed));
    EXPECT_LT(most, 8.0 * kSpeed);
}

TEST_F(GapsTest, ABallThatDipsIntoACornerThrowsNoFluidAbout) {
    constexpr double kRadius = 0.032, kDip = 0.5 * 0.16 / 25, kOmega = 6.283 * 5.0;
    FluidSetup s = tank();
    s.bodies = {BodySetup{Sphere{kRadius}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const double most = fastest(*fluid, 50, [](double t) {
        return std::vector<BodyState>{{.centre_m = glm::dvec3(kRadius + kDip * std::sin(kOmega * t)),
                                       .velocity_m_s = glm::dvec3(kDip * kOmega * std::cos(kOmega * t))}};
    });
    const double speed = std::sqrt(3.0) * kDip * kOmega;
    RecordProperty("times_as_fast", std::to_string(most / speed));
    EXPECT_LT(most, 8.0 * speed);
}

TEST_F(GapsTest, ABodyInTheWallsOfAClosedTankLeavesThePressureWhereItWas) {
    // Its volume in the tank changes, which no pressure answers: each step moved the whole of it on.
    constexpr double kRadius = 0.032, kSpeed = 0.05;
    FluidSetup s = tank();
    s.bodies = {BodySetup{Sphere{kRadius}}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const auto level_pa = [&] {
        double sum = 0.0;
        const std::vector<float> pressures = fluid->pressure();
        for (const float p : pressures) sum += p;
        return std::abs(sum) / static_cast<double>(pressures.size());
    };
    double first_pa = 0.0, last_pa = 0.0;
    fastest(*fluid, 30, [&](double t) {
        const int step = static_cast<int>(std::lround(t / kGapStepS));
        if (step > 1) (step <= 6 ? first_pa : last_pa) = std::max(step <= 6 ? first_pa : last_pa, level_pa());
        return std::vector<BodyState>{
            {.centre_m = {kRadius - kSpeed * t, 0.08, 0.08}, .velocity_m_s = {-kSpeed, 0.0, 0.0}}};
    });
    RecordProperty("first_pa", std::to_string(first_pa));
    RecordProperty("last_pa", std::to_string(last_pa));
    // Measured: 0.046 and 0.013 Pa; without the guard 0.87 and 0.046 Pa.
    EXPECT_LT(last_pa, 8.0 * first_pa);
    EXPECT_LT(last_pa, 0.2);
}

}  // namespace
}  // namespace eddy::gles
