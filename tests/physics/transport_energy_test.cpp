#include <random>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

struct Mode {
    const char* name;
    Advection advection;
    int time_order;
};

class TransportEnergy : public GlTest, public testing::WithParamInterface<Mode> {};

/// Velocities at random, so that most of the energy is at the scale of the cells, where the correction of MacCormack does worst.
FluidSetup unrest(const Mode& mode) {
    FluidSetup s = unit_tank({10, 9, 8}, 0.0, mode.advection, 6);
    s.solver.time_order = mode.time_order;
    s.velocity_at_start = [draw = std::mt19937(1)](const glm::dvec3&) mutable {
        std::uniform_real_distribution<double> any(-1.0, 1.0);
        const double x = any(draw), y = any(draw), z = any(draw);
        return glm::dvec3(x, y, z);
    };
    return s;
}

std::vector<double> energies(Gpu& gpu, const FluidSetup& setup, int steps) {
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, setup);
    std::vector<double> found;
    for (int i = 0; i < steps; ++i) {
        fluid->step(0.2, {}, true);
        found.push_back(fluid->wait_result().diagnostics->kinetic_energy_j);
    }
    return found;
}

void expect_never_grows(const std::vector<double>& found, const char* where) {
    double least = std::numeric_limits<double>::infinity(), most_growth = 0.0;
    for (const double energy : found) {
        most_growth = std::max(most_growth, energy / least - 1.0);
        least = std::min(least, energy);
    }
    record(where, most_growth);
    EXPECT_LT(most_growth, 1e-3) << where;
    EXPECT_GT(least, 0.0) << where;
}

TEST_P(TransportEnergy, InAClosedTankNeverGrows) {
    expect_never_grows(energies(gpu, unrest(GetParam()), 300), "growth");
}

TEST_P(TransportEnergy, OfAFlowThatTurnsBackAtAnOpeningNeverGrows) {
    // Outside, the fluid is at rest. With one wall open, and with all.
    for (const int openings : {1, 6}) {
        FluidSetup s = unrest(GetParam());
        for (int i = 0; i < openings; ++i) s.walls[static_cast<std::size_t>(i)].kind = WallKind::Open;
        expect_never_grows(energies(gpu, s, 200), fmt::format("growth, {} open", openings).c_str());
    }
}

TEST_P(TransportEnergy, MayComeInThroughAnInflow) {
    FluidSetup s = unrest(GetParam());
    s.velocity_at_start = nullptr;
    s.walls[0] = {.kind = WallKind::Inflow, .velocity_m_s = {{"1.0", "0.0", "0.0"}}};
    s.walls[0].velocity_at = [](const glm::dvec3&, double) { return glm::dvec3(1.0, 0.0, 0.0); };
    s.walls[1].kind = WallKind::Open;
    const std::vector<double> found = energies(gpu, s, 100);
    EXPECT_NEAR(found.back(), 0.5 * 10 * 9 * 8, 0.02 * 0.5 * 10 * 9 * 8);
}

INSTANTIATE_TEST_SUITE_P(Modes, TransportEnergy,
                         testing::Values(Mode{"carried", Advection::SemiLagrangian, 1},
                                         Mode{"reflected", Advection::SemiLagrangian, 2},
                                         Mode{"corrected", Advection::MacCormack, 1},
                                         Mode{"both", Advection::MacCormack, 2}),
                         [](const auto& mode) { return mode.param.name; });

}  // namespace
}  // namespace eddy::gles
