#include "gles/yang2009/jacobi.h"

#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using JacobiTest = GlTest;

std::vector<double> plain_sweeps(const VoxelGrid& grid, const std::vector<float>& d, int sweeps) {
    std::vector<double> phi(grid.count(), 0.0), next(grid.count());
    for (int s = 0; s < sweeps; ++s) {
        grid.for_each_cell([&](const glm::ivec3& c) {
            double sum = -d[grid.index(c)];
            for (const glm::ivec3& e : kSixWays)
                sum += phi[grid.index(!grid.in_tank(c + e) || grid.solid(c + e) ? c : c + e)];
            next[grid.index(c)] = sum / 6.0;
        });
        phi.swap(next);
    }
    return phi;
}

void expect_same(const std::vector<float>& found, const std::vector<double>& expected) {
    for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(found[i], expected[i], 1e-5);  // 80 roundings of 1
}

TEST_F(JacobiTest, TwentySweepsAroundASphereEqualAPlainLoop) {
    const VoxelGrid grid;
    const std::vector<float> d = grid.random_field(5);
    const Voxels voxels = grid.voxels(gpu);
    Jacobi jacobi(gpu, grid.n, &voxels);
    const Field<Cells> phi = jacobi.solve(grid.upload(gpu, d), 20);
    expect_same(unpack_scalars(phi.texture().download(), phi.layout()), plain_sweeps(grid, d, 20));
}

TEST_F(JacobiTest, SweepsInAnEmptyTankEqualAPlainLoop) {
    VoxelGrid grid;
    grid.radius = 0.0;
    const std::vector<float> d = grid.random_field(6);
    Jacobi jacobi(gpu, grid.n, nullptr);
    const Field<Cells> phi = jacobi.solve(grid.upload(gpu, d), 7);
    expect_same(unpack_scalars(phi.texture().download(), phi.layout()), plain_sweeps(grid, d, 7));
}

TEST_F(JacobiTest, StartsFromZeroEveryTime) {
    const VoxelGrid grid;
    const Voxels voxels = grid.voxels(gpu);
    Jacobi jacobi(gpu, grid.n, &voxels);
    const Field<Cells> d = grid.upload(gpu, grid.random_field(7));
    const Field<Cells> first = jacobi.solve(d, 3), second = jacobi.solve(d, 3);
    EXPECT_EQ(unpack_scalars(first.texture().download(), first.layout()),
              unpack_scalars(second.texture().download(), second.layout()));
}

}  // namespace
}  // namespace eddy::gles
