#include <cmath>
#include <numbers>
#include <numeric>

#include "gles/grid_io.h"
#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Heat = GlTest;

/// A closed tank in units of cells with heat in it, spreading by `diffusion` cells squared a second.
FluidSetup warm_tank(const glm::ivec3& n, double diffusion,
                     std::function<double(const glm::dvec3&)> at_start_k) {
    FluidSetup s = unit_tank(n, 0.0, Advection::MacCormack, 2);
    s.temperature = TemperatureSetup{0.0, diffusion, std::move(at_start_k)};
    return s;
}

std::vector<float> temperature(const Fluid& fluid) {
    return unpack_scalars(fluid.temperature()->texture().download(), fluid.temperature()->layout());
}

TEST_F(Heat, OfACosineSpreadsAtTheRateOfTheGrid) {
    // (1 - kappa dt lap) has the cosines of a closed box as eigenvectors: a step divides them by
    // 1 + kappa dt / h^2 sum (2 - 2 cos k h).
    double worst_of_all = 0.0;
    for (const glm::ivec3 n : {glm::ivec3(32, 20, 16), glm::ivec3(25, 18, 13)})
        for (const double diffusion : {0.01, 0.1, 0.25, 0.3, 1.0, 10.0, 1000.0}) {
            const glm::dvec3 k = std::numbers::pi * glm::dvec3(1.0, 2.0, 3.0) / glm::dvec3(n);
            const std::unique_ptr<Fluid> fluid =
                make_fluid(gpu, warm_tank(n, diffusion, [k](const glm::dvec3& x) {
                               return std::cos(k.x * x.x) * std::cos(k.y * x.y) * std::cos(k.z * x.z);
                           }));
            const std::vector<float> before = temperature(*fluid);
            fluid->step(1.0, {}, false);
            const std::vector<float> after = temperature(*fluid);
            const double fall = diffusion * (6.0 - 2.0 * (std::cos(k.x) + std::cos(k.y) + std::cos(k.z)));
            double worst = 0.0;
            for (std::size_t i = 0; i < before.size(); ++i)
                worst = std::max(worst, std::abs(after[i] * (1.0 + fall) - static_cast<double>(before[i])));
            // Of what is left, and of what has gone.
            EXPECT_LT(worst, 0.015) << diffusion;
            EXPECT_LT(worst, 0.0015 * fall) << diffusion;
            worst_of_all = std::max(worst_of_all, worst);
        }
    record("error_of_what_is_left", worst_of_all);
}

TEST_F(Heat, OfOneHotCellStaysWithinItsBoundsAndIsNotLost) {
    const glm::ivec3 n(32, 24, 16);
    for (const double diffusion : {0.1, 1.0, 10.0, 1000.0}) {
        const std::unique_ptr<Fluid> fluid =
            make_fluid(gpu, warm_tank(n, diffusion, [](const glm::dvec3& x) {
                           return glm::distance(x, glm::dvec3(8.5, 9.5, 10.5)) < 0.1 ? 1.0 : 0.0;
                       }));
        for (int step = 0; step < 5; ++step) {
            fluid->step(1.0, {}, true);
            // The second part: a float's last digit of lambda times the differences in the first step.
            EXPECT_NEAR(fluid->wait_result().diagnostics->temperature_total, 1.0, 1e-6 + 2e-8 * diffusion)
                << diffusion;
            const std::vector<float> t = temperature(*fluid);
            const auto [least, most] = std::minmax_element(t.begin(), t.end());
            EXPECT_GT(*least, -1e-6f) << diffusion;
            EXPECT_LT(*most, 1.0f / (1.0f + static_cast<float>(diffusion))) << diffusion;
        }
    }
}

TEST_F(Heat, DoesNotPassThroughAPlate) {
    // Warm on one side of a plate 4 cells thick that fills the tank from wall to wall, cold on the other. Where heat reaches
    // far in a step the coarse grids that carry it see no plate, and the cycles must mend that.
    const glm::ivec3 n(24, 12, 12);
    for (const double diffusion : {0.2, 1.0, 10.0}) {
        FluidSetup s = warm_tank(n, diffusion, [](const glm::dvec3& x) { return x.x < 6.0 ? 1.0 : 0.0; });
        s.bodies = {BodySetup{Cuboid{{4.0, 40.0, 40.0}}}};
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        BodyState plate;
        plate.centre_m = {12.3, 6.0, 6.0};
        for (int step = 0; step < 10; ++step) fluid->step(1.0, {plate}, false);
        const std::vector<float> t = temperature(*fluid);
        double cold = 0.0, warm = 0.0;
        for (std::size_t i = 0; i < t.size(); ++i) {
            const int x = static_cast<int>(i) % n.x;
            if (x >= 15) cold = std::max(cold, std::abs(static_cast<double>(t[i])));
            if (x < 9) warm += t[i] / (9.0 * n.y * n.z);
        }
        EXPECT_LT(cold, diffusion > 1.0 ? 1e-4 : 1e-6) << diffusion;
        if (diffusion < 10.0) continue;
        // It has mixed: 6 warm cells of the 10.3 in front of the plate.
        EXPECT_NEAR(warm, 6.0 / 10.3, 0.005);
        record("behind", cold);
    }
}

TEST_F(Heat, FromASourceAddsUpToItsRate) {
    // The ball's edge is one cell soft; over it, the ball has its volume to within 1 / (4 r^2).
    const double radius = 4.3, rate = -2.5, dt = 0.1;
    FluidSetup s = warm_tank({16, 18, 20}, 0.3, {});
    s.sources = {SourceSetup{.centre_m = {8.0, 9.2, 10.1},
                             .radius_m = radius,
                             .temperature_k_per_s = rate,
                             .stop_s = 10.0 * dt - 1e-9}};
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    const double volume = 4.0 / 3.0 * std::numbers::pi * radius * (radius * radius + 0.25);
    for (int step = 1; step <= 12; ++step) {
        fluid->step(dt, {}, true);
        const double total = fluid->wait_result().diagnostics->temperature_total;
        EXPECT_NEAR(total / (rate * dt * volume), std::min(step, 10), 0.005 * std::min(step, 10));
        if (step == 10) record("relative", total / (rate * dt * volume * 10.0));
    }
}

TEST_F(Heat, ThatIsTheSameEverywhereStaysSoWhereABodyMoves) {
    // So does smoke: nothing is made or eaten at the surface. Validation case A16.
    for (const Advection advection : {Advection::SemiLagrangian, Advection::MacCormack}) {
        FluidSetup s = unit_tank({24, 20, 16}, 3.7, advection, 3);
        const auto one = [](const glm::dvec3&) { return 1.0; };
        s.temperature = TemperatureSetup{0.0, 0.4, one};
        s.smoke = SmokeSetup{};
        s.smoke->at_start = one;
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        for (int step = 1; step <= 20; ++step) {
            BodyState ball;
            ball.centre_m = {6.0 + 0.5 * step, 10.2, 7.7};
            ball.velocity_m_s = {0.5, 0.0, 0.0};
            fluid->step(1.0, {ball}, false);
        }
        const Field<Cells>& smoke = *fluid->smoke();
        for (const std::vector<float>& values :
             {temperature(*fluid), unpack_scalars(smoke.texture().download(), smoke.layout())}) {
            const auto [least, most] = std::minmax_element(values.begin(), values.end());
            EXPECT_NEAR(*least, 1.0, 1e-6);
            EXPECT_NEAR(*most, 1.0, 1e-6);
        }
    }
}

}  // namespace
}  // namespace eddy::gles
