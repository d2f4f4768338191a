#include "gles/yang2009/viscosity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using ViscosityTest = GlTest;

/// The velocity after a step with k = nu dt / h^2.
std::vector<glm::vec3> diffuse(Gpu& gpu, const VoxelGrid& grid, const std::vector<glm::vec3>& star, float k) {
    const Voxels voxels = grid.voxels(gpu);
    const FluidSetup setup = unit_setup(grid.n, 1);
    Viscosity viscosity(gpu, setup, grid.radius > 0.0 ? &voxels : nullptr);
    const Field<Cells> u = viscosity.solve(grid.upload(gpu, star), k, 0.0);
    return unpack_vectors(u.texture().download(), u.layout());
}

/// Random, and the sphere's own velocity inside it.
std::vector<glm::vec3> random_star(const VoxelGrid& grid) {
    std::vector<glm::vec3> star = grid.random_velocity(3);
    grid.for_each_cell([&](const glm::ivec3& c) {
        if (grid.solid(c)) star[grid.index(c)] = glm::vec3(grid.velocity);
    });
    return star;
}

TEST_F(ViscosityTest, SweepsAroundASphereEqualAPlainLoop) {
    const VoxelGrid grid;
    const std::vector<glm::vec3> star = random_star(grid), found = diffuse(gpu, grid, star, 0.7f);
    const std::vector<glm::dvec3> expected =
        diffused(grid, std::vector<glm::dvec3>(star.begin(), star.end()), 0.7, Viscosity::kSweeps);
    for (std::size_t i = 0; i < found.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(found[i][axis], expected[i][axis], 2e-6);
}

/// Sines across the walls and cosines along them, which free slip leaves in shape.
struct TaylorGreen {
    glm::dvec3 wave{1.0, 2.0, 1.0};  // half waves in the tank

    std::vector<glm::vec3> velocity(const VoxelGrid& grid) const {
        std::vector<glm::vec3> u(grid.count());
        grid.for_each_cell([&](const glm::ivec3& c) {
            const glm::dvec3 x = std::numbers::pi * wave * (glm::dvec3(c) + 0.5) / glm::dvec3(grid.n);
            const glm::dvec3 s = glm::sin(x), q = glm::cos(x);
            u[grid.index(c)] =
                glm::vec3(glm::dvec3(s.x * q.y * q.z, -0.5 * q.x * s.y * q.z, 0.25 * q.x * q.y * s.z));
        });
        return u;
    }
    /// The sum of six neighbours over the cell between them.
    double neighbours(const VoxelGrid& grid) const {
        const glm::dvec3 q = glm::cos(std::numbers::pi * wave / glm::dvec3(grid.n));
        return 2.0 * (q.x + q.y + q.z);
    }
};

void expect_decay(const VoxelGrid& grid, const std::vector<glm::vec3>& found, double factor,
                  double tolerance) {
    const std::vector<glm::vec3> star = TaylorGreen{}.velocity(grid);
    for (std::size_t i = 0; i < found.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(found[i][axis], factor * star[i][axis], tolerance);
}

TEST_F(ViscosityTest, TaylorGreenVortexDecaysAtTheRateOfTheDiscreteLaplacian) {
    VoxelGrid grid;
    grid.radius = 0.0;
    const double lambda = 6.0 - TaylorGreen{}.neighbours(grid), k = 0.1;
    const std::vector<glm::vec3> u = diffuse(gpu, grid, TaylorGreen{}.velocity(grid), 0.1f);
    expect_decay(grid, u, 1.0 / (1.0 + k * lambda), 1e-6);  // 20 sweeps leave less than (0.6 / 1.6)^20 = 3e-9
    EXPECT_GT(k * lambda, 0.05);
}

// The sweeps stop short of the solution by as much as theory says, and on the side of too little viscosity.
TEST_F(ViscosityTest, TaylorGreenVortexDecaysAsTwentySweepsCanWhereViscosityIsLarge) {
    VoxelGrid grid;
    grid.radius = 0.0;
    const double s = TaylorGreen{}.neighbours(grid), k = 30.0;
    double factor = 1.0;
    for (int sweep = 0; sweep < Viscosity::kSweeps; ++sweep)
        factor = (1.0 + k * s * factor) / (1.0 + 6.0 * k);
    expect_decay(grid, diffuse(gpu, grid, TaylorGreen{}.velocity(grid), 30.0f), factor, 2e-6);
    EXPECT_GT(factor, 1.2 / (1.0 + k * (6.0 - s)));
}

TEST_F(ViscosityTest, NoVelocityGrowsHoweverThickTheFluid) {
    const VoxelGrid grid;
    const std::vector<glm::vec3> star = random_star(grid);
    float most = 0.0f;
    for (const glm::vec3& u : star) most = std::max({most, std::abs(u.x), std::abs(u.y), std::abs(u.z)});
    for (const float k : {1.0f, 1e3f, 1e6f})
        for (const glm::vec3& u : diffuse(gpu, grid, star, k))
            for (int axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(u[axis]), 1.00001f * most);
}

TEST_F(ViscosityTest, SphereDragsTheFluidAlongAndTheWallsDoNotHoldIt) {
    VoxelGrid grid;
    grid.velocity = {0.0, 0.0, 1.0};
    std::vector<glm::vec3> star(grid.count(), glm::vec3(0.0f, 0.0f, 1.0f));
    // Moving with the sphere, the fluid keeps its velocity except at the walls across it.
    const std::vector<glm::vec3> together = diffuse(gpu, grid, star, 1e-3f);
    EXPECT_NEAR(together[grid.index({0, 0, 6})].z, 1.0f, 1e-6f);
    EXPECT_LT(together[grid.index({0, 0, 0})].z, 0.999f);
    // At rest, it is dragged along: by k of the difference through each face shared with the sphere.
    grid.for_each_cell([&](const glm::ivec3& c) {
        if (!grid.solid(c)) star[grid.index(c)] = glm::vec3(0.0f);
    });
    const std::vector<glm::vec3> dragged = diffuse(gpu, grid, star, 1e-3f);
    grid.for_each_cell([&](const glm::ivec3& c) {
        if (grid.solid(c)) return;
        double shared = 0.0;
        for (const glm::ivec3& e : kSixWays) shared += grid.solid(c + e) ? 1.0 : 0.0;
        ASSERT_NEAR(dragged[grid.index(c)].z, 1e-3 * shared, 2e-5);  // and k^2 of neighbours' neighbours
    });
}

// One wall at rest and one that moves as t sin(pi x / L) stir a fluid that cannot flow through the walls of
// x. In cells, the discrete equations have the steady solution, with cosh theta = 2 - cos(pi / L),
// u = t sin(pi x / L) sinh(theta z) / (sinh(theta H) cosh(theta / 2)).
TEST_F(ViscosityTest, WallWithFrictionStirsTheFluidAsTheDiscreteSolutionSays) {
    VoxelGrid grid;
    grid.n = {5, 3, 7};
    FluidSetup setup = unit_setup(grid.n, 1);
    setup.walls[4].kind = setup.walls[5].kind = WallKind::NoSlip;
    setup.walls[5].velocity_m_s.glsl = {"t * sin(3.14159265 * x / 5.0)", "0.0", "0.0"};
    Viscosity viscosity(gpu, setup, nullptr);
    Field<Cells> u = grid.upload(gpu, std::vector<glm::vec3>(grid.count()));
    for (int step = 0; step < 100; ++step) u = viscosity.solve(u, 1.0f, 0.5);

    const double theta = std::acosh(2.0 - std::cos(std::numbers::pi / 5.0));
    const double scale = 0.5 / (std::sinh(7.0 * theta) * std::cosh(0.5 * theta));
    const std::vector<glm::vec3> found = unpack_vectors(u.texture().download(), u.layout());
    grid.for_each_cell([&](const glm::ivec3& c) {
        const double expected =
            scale * std::sin(std::numbers::pi * (c.x + 0.5) / 5.0) * std::sinh(theta * (c.z + 0.5));
        ASSERT_NEAR(found[grid.index(c)].x, expected, 1e-6);
        ASSERT_EQ(found[grid.index(c)].y, 0.0f);
        ASSERT_EQ(found[grid.index(c)].z, 0.0f);
    });
    EXPECT_GT(found[grid.index({2, 1, 6})].x, 0.3f);
}

}  // namespace
}  // namespace eddy::gles
