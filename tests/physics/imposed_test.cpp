#include <cmath>
#include <numbers>
#include <numeric>

#include "gles/grid_io.h"
#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using ImposedFlow = GlTest;

/// A box 1 m wide in which smoke follows a formula.
FluidSetup unit_box(const glm::ivec3& cells, VectorFormula velocity_m_s, Advection advection,
                    std::function<double(const glm::dvec3&)> smoke_at_start) {
    FluidSetup s;
    s.cells = cells;
    s.cell_m = 1.0 / cells.x;
    s.solver.advection = advection;
    s.imposed = ImposedSetup{std::move(velocity_m_s), false};
    s.smoke = SmokeSetup{};
    s.smoke->at_start = std::move(smoke_at_start);
    return s;
}

std::vector<float> smoke(const Fluid& fluid) {
    return unpack_scalars(fluid.smoke()->texture().download(), fluid.smoke()->layout());
}

/// sum |s - s_0| / sum s_0 when the flow should have brought all smoke back to where it was.
double displaced(Gpu& gpu, const FluidSetup& setup, double seconds, int steps) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    const std::vector<float> before = smoke(*fluid);
    for (int i = 0; i < steps; ++i) fluid->step(seconds / steps, {}, false);
    const std::vector<float> after = smoke(*fluid);
    double sum = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i)
        sum += std::abs(static_cast<double>(after[i] - before[i]));
    return sum / std::accumulate(before.begin(), before.end(), 0.0);
}

TEST_F(ImposedFlow, TurnsACloudAtSecondOrder) {
    // A whole turn about the middle.
    const VectorFormula u{{"0.5 - y", "x - 0.5", "0.0"}};
    const auto cloud = [](const glm::dvec3& x) {
        const glm::dvec2 r = glm::dvec2(x.x - 0.65, x.y - 0.5) / 0.12;
        return std::exp(-glm::dot(r, r));
    };
    const auto run = [&](int n, Advection advection) {
        return displaced(gpu, unit_box({n, n, 4}, u, advection, cloud), 2.0 * std::numbers::pi, 4 * n);
    };
    const double good = run(32, Advection::MacCormack), better = run(64, Advection::MacCormack);
    record("maccormack_32", good);
    record("maccormack_64", better);
    EXPECT_GT(std::log2(good / better), 1.6);
    EXPECT_LT(good, 0.5 * run(32, Advection::SemiLagrangian));
}

TEST_F(ImposedFlow, CarriesByWholeCellsWithoutLossAndBringsClearFluidIn) {
    // In a second 4 cells along x, and down by -1: the middle of the step counts.
    const auto slope = [](const glm::dvec3& x) { return 1.0 + x.x + 2.0 * x.y; };
    for (const Advection advection : {Advection::SemiLagrangian, Advection::MacCormack}) {
        const FluidSetup s = unit_box(glm::ivec3(16), {{"0.25", "-0.125 * t", "0.0"}}, advection, slope);
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        fluid->step(1.0, {}, false);
        const std::vector<float> row = smoke(*fluid);
        for (int x = 0; x < 16; ++x) {
            const double exact = x < 4 ? 0.0 : slope({(x - 3.5) / 16.0, 9.5 / 16.0, 0.0});
            EXPECT_NEAR(row[static_cast<std::size_t>(x + 16 * (8 + 16 * 8))], exact, 2e-6) << x;
        }
    }
}

TEST_F(ImposedFlow, SaysHowMuchFlowsOutOfItsCells) {
    FluidSetup s =
        unit_box(glm::ivec3(16), {{"2.0 * x + t", "-0.5 * y", "3.0"}}, Advection::SemiLagrangian, {});
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
    fluid->step(1.0, {}, true);
    EXPECT_NEAR(fluid->wait_result().diagnostics->divergence_max_1_s, 1.5, 1e-4);
    EXPECT_NEAR(fluid->velocity()[16].x, 2.0 + 1.0, 1e-6);
}

}  // namespace
}  // namespace eddy::gles
