#include "gles/yang2009/yang2009.h"
#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using Yang2009Step = GlTest;

constexpr int kSweeps = 6;
constexpr double kDt = 0.7;

/// Trilinear between cell centres, clamped to the outermost ones.
template <class T>
T sample(const VoxelGrid& grid, const std::vector<T>& field, glm::dvec3 s) {
    s = glm::clamp(s - 0.5, glm::dvec3(0.0), glm::dvec3(grid.n - 1));
    const glm::ivec3 low(glm::floor(s));
    const glm::dvec3 f = s - glm::dvec3(low);
    T sum(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 e(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(e));
        sum += (w.x * w.y * w.z) * field[grid.index(glm::min(low + e, grid.n - 1))];
    }
    return sum;
}

/// One step of the method in plain loops and doubles.
struct PlainStep {
    const VoxelGrid& grid;
    double diffusion = 0.0;  // nu dt / h^2
    std::vector<glm::dvec3> u{}, star{};
    std::vector<double> phi{};

    double divergence(const glm::ivec3& c) const {
        double d = 0.0;
        for (const glm::ivec3& e : kSixWays)
            if (grid.in_tank(c + e)) d += 0.5 * glm::dot(u[grid.index(c + e)], glm::dvec3(e));
        return d;
    }
    double phi_beside(const glm::ivec3& c, const glm::ivec3& e) const {
        return phi[grid.index(!grid.in_tank(c + e) || grid.solid(c + e) ? c : c + e)];
    }
    void run() {
        std::vector<glm::dvec3> next(grid.count());
        grid.for_each_cell([&](const glm::ivec3& c) {
            const glm::dvec3 x = glm::dvec3(c) + 0.5;
            next[grid.index(c)] = grid.solid(c) ? grid.velocity : sample(grid, u, x - kDt * u[grid.index(c)]);
        });
        star = diffused(grid, next, diffusion, Viscosity::kSweeps);
        u = next = star;
        std::vector<double> swept(grid.count());
        phi.assign(grid.count(), 0.0);
        for (int i = 0; i < kSweeps; ++i) {
            grid.for_each_cell([&](const glm::ivec3& c) {
                double sum = -divergence(c);
                for (const glm::ivec3& e : kSixWays) sum += phi_beside(c, e);
                swept[grid.index(c)] = sum / 6.0;
            });
            phi = swept;
        }
        grid.for_each_cell([&](const glm::ivec3& c) {
            if (grid.solid(c)) return;
            for (const glm::ivec3& e : kSixWays)
                next[grid.index(c)] -= 0.5 * phi_beside(c, e) * glm::dvec3(e);
            for (const glm::ivec3& e : kSixWays)
                for (int axis = 0; axis < 3; ++axis) {
                    if (e[axis] == 0) continue;
                    if (!grid.in_tank(c + e)) next[grid.index(c)][axis] = 0.0;
                    if (grid.solid(c + e)) next[grid.index(c)][axis] = grid.velocity[axis];
                }
        });
        u = next;
    }
};

void expect_step_equals_plain_loop(Gpu& gpu, bool filters, double viscosity) {
    const VoxelGrid grid;
    gpu.set_filters_float(filters);
    FluidSetup setup = unit_setup(grid.n, kSweeps);
    setup.bodies = grid.bodies();
    setup.viscosity_pa_s = viscosity;
    Yang2009Fluid fluid(gpu, setup);
    gpu.set_filters_float(true);

    PlainStep plain{.grid = grid, .diffusion = viscosity * kDt};
    const std::vector<glm::vec3> u0 = grid.random_velocity(1);
    for (const glm::vec3& v : u0) plain.u.emplace_back(v);
    fluid.set_velocity(u0);
    for (int step = 0; step < 2; ++step) {
        fluid.step(kDt, {grid.state()}, false);
        plain.run();
    }
    const std::vector<glm::vec3> u = fluid.velocity();
    const std::vector<float> p = fluid.pressure();
    // A driver may filter with weights of 8 bits (the GLES minimum): 1/512 of differences up to 2, twice.
    const double tolerance = filters ? 2e-2 : 1e-5;
    grid.for_each_cell([&](const glm::ivec3& c) {
        const std::size_t i = grid.index(c);
        for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(u[i][axis], plain.u[i][axis], tolerance);
        if (!grid.solid(c)) {
            ASSERT_NEAR(p[i], plain.phi[i] / kDt, tolerance);
        }
    });
    fluid.result(true);
    const Load found = fluid.result(true)->loads[0];
    const ForceAndMoment expected = sum_over_faces(grid, plain.phi, plain.star, plain.diffusion);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.force_n[axis], expected.force[axis] / kDt, 20.0 * tolerance);
        EXPECT_NEAR(found.torque_nm[axis], expected.moment[axis] / kDt, 60.0 * tolerance);
    }
}

TEST_F(Yang2009Step, TwoStepsEqualAPlainLoop) {
    expect_step_equals_plain_loop(gpu, false, 0.0);
}

TEST_F(Yang2009Step, TwoStepsEqualAPlainLoopWithTheDriversOwnFilter) {
    expect_step_equals_plain_loop(gpu, true, 0.0);
}

TEST_F(Yang2009Step, TwoStepsOfAViscousFluidEqualAPlainLoop) {
    expect_step_equals_plain_loop(gpu, false, 0.4);
}

}  // namespace
}  // namespace eddy::gles
