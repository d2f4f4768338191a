#include "gles/yang2009/force.h"

#include <algorithm>
#include <functional>

#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using VoxelForceTest = GlTest;
using Velocity = std::function<glm::dvec3(const glm::dvec3& x)>;

constexpr float kDiffusion = 0.5f;  // nu dt / h^2

ForceAndMoment sum_on_gpu(Gpu& gpu, const VoxelGrid& grid, const std::vector<float>& phi,
                          const std::vector<glm::vec3>& u, double viscosity) {
    const Voxels voxels = grid.voxels(gpu);
    FluidSetup setup = unit_setup(grid.n, 1);
    setup.bodies = grid.bodies();
    setup.viscosity_pa_s = viscosity;
    VoxelForce force(gpu, setup, 3);
    const TexturePool::Lease results = gpu.textures().lease({3, 1}, Format::RGBA32F);
    force.draw(grid.upload(gpu, phi), grid.upload(gpu, u), kDiffusion, voxels, grid.uniforms(gpu),
               {grid.state()}, *results);
    const std::vector<glm::vec4> texels = results.get()->download();
    return {glm::dvec3(texels[0]), glm::dvec3(texels[1])};
}

/// Of the pressure alone, in an inviscid fluid that moves anyhow.
ForceAndMoment of_pressure(Gpu& gpu, const VoxelGrid& grid, const std::vector<float>& phi) {
    return sum_on_gpu(gpu, grid, phi, grid.random_velocity(12), 0.0);
}

/// Of the viscous stress alone, where the velocity is a formula, inside the sphere too.
ForceAndMoment of_stress(Gpu& gpu, const VoxelGrid& grid, const Velocity& velocity) {
    std::vector<glm::vec3> u(grid.count());
    grid.for_each_cell(
        [&](const glm::ivec3& c) { u[grid.index(c)] = glm::vec3(velocity(glm::dvec3(c) + 0.5)); });
    return sum_on_gpu(gpu, grid, std::vector<float>(grid.count()), u, 1.0);
}

void expect_equal(const ForceAndMoment& found, const ForceAndMoment& expected) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.force[i], expected.force[i], 2e-5);  // about 150 faces, stresses up to 2
        EXPECT_NEAR(found.moment[i], expected.moment[i], 1e-4);
    }
    EXPECT_GT(glm::length(expected.force), 1.0);
}

TEST_F(VoxelForceTest, EqualsAPlainSumOverFaces) {
    const VoxelGrid grid;
    const std::vector<float> phi = grid.random_field(11);
    expect_equal(of_pressure(gpu, grid, phi), sum_over_faces(grid, phi, grid.random_velocity(12), 0.0));
}

TEST_F(VoxelForceTest, InAViscousFluidEqualsAPlainSumOfTheStressTensorOverFaces) {
    VoxelGrid grid;
    const std::vector<float> phi = grid.random_field(11);
    const std::vector<glm::vec3> u = grid.random_velocity(13);
    expect_equal(sum_on_gpu(gpu, grid, phi, u, 1.0), sum_over_faces(grid, phi, u, kDiffusion));
    grid.centre.y = 1.2;  // sticks out of the tank
    expect_equal(sum_on_gpu(gpu, grid, phi, u, 1.0), sum_over_faces(grid, phi, u, kDiffusion));
}

TEST_F(VoxelForceTest, UniformPressurePushesNowhere) {
    const VoxelGrid grid;
    const ForceAndMoment sum = of_pressure(gpu, grid, std::vector<float>(grid.count(), 3.0f));
    EXPECT_EQ(sum.force, glm::dvec3(0.0));
    EXPECT_NEAR(glm::length(sum.moment), 0.0, 1e-4);
}

// The pressure is taken half a cell outside each face, so a row of L cells feels the difference over L + 1.
TEST_F(VoxelForceTest, LinearPressurePushesDownhillByVolumePlusShadow) {
    const VoxelGrid grid;
    std::vector<float> phi(grid.count());
    double volume = 0.0, shadow = 0.0;
    grid.for_each_cell([&](const glm::ivec3& c) {
        phi[grid.index(c)] = static_cast<float>(c.y);
        if (grid.solid(c)) volume += 1.0;
        if (grid.solid(c) && !grid.solid(c + glm::ivec3(0, 1, 0))) shadow += 1.0;
    });
    const ForceAndMoment sum = of_pressure(gpu, grid, phi);
    EXPECT_EQ(sum.force, glm::dvec3(0.0, -(volume + shadow), 0.0));
}

TEST_F(VoxelForceTest, UniformStressNeitherPushesNorTurns) {
    const VoxelGrid grid;
    const glm::dmat3 du(1.0, 2.0, -3.0, 5.0, -2.0, 4.0, -7.0, 1.0, 2.0);
    const glm::dmat3 couette(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0);  // u = (3 y, 0, 0)
    for (const glm::dmat3& gradient : {du, couette}) {
        const ForceAndMoment sum = of_stress(gpu, grid, [&](const glm::dvec3& x) { return gradient * x; });
        EXPECT_EQ(sum.force, glm::dvec3(0.0));
        EXPECT_NEAR(glm::length(sum.moment), 0.0, 2e-4);  // 150 faces, stresses up to 5, arms up to 3
    }
}

TEST_F(VoxelForceTest, CouetteFlowDragsWhatStandsOnTheFloorByTheStressTimesItsFootprint) {
    VoxelGrid grid;
    grid.centre.y = 0.3;
    double footprint = 0.0;
    grid.for_each_cell([&](const glm::ivec3& c) {
        if (c.y == 0 && grid.solid(c)) footprint += 1.0;
    });
    const ForceAndMoment sum =
        of_stress(gpu, grid, [](const glm::dvec3& x) { return glm::dvec3(3.0 * x.y, 0.0, 0.0); });
    EXPECT_EQ(sum.force, glm::dvec3(kDiffusion * 3.0 * footprint, 0.0, 0.0));
    EXPECT_GT(footprint, 15.0);
}

// div tau = k (laplacian u + grad div u), the same everywhere if u is quadratic. Central differences are then
// exact, and what two cells exchange through their face cancels: a discrete divergence theorem.
TEST_F(VoxelForceTest, StressThatVariesLinearlyPushesEachVoxelByItsDivergence) {
    const VoxelGrid grid;
    const ForceAndMoment sum = of_stress(gpu, grid, [](const glm::dvec3& x) {
        return glm::dvec3(x.x * x.x + 2.0 * x.y * x.y - x.x * x.z, 3.0 * x.x * x.y - x.z * x.z + x.y * x.y,
                          x.y * x.z + x.z * x.z - 2.0 * x.x * x.x);
    });
    const glm::dvec3 laplacian(2.0 + 4.0, -2.0 + 2.0, 2.0 - 4.0);
    const glm::dvec3 grad_div(2.0 + 3.0, 2.0 + 1.0, -1.0 + 2.0);  // div u = (2x - z) + (3x + 2y) + (y + 2z)
    const glm::dvec3 per_voxel = static_cast<double>(kDiffusion) * (laplacian + grad_div);
    ForceAndMoment expected;
    grid.for_each_cell([&](const glm::ivec3& c) {
        if (!grid.solid(c)) return;
        expected.force += per_voxel;
        expected.moment += glm::cross(glm::dvec3(c) + 0.5 - grid.centre, per_voxel);
    });
    EXPECT_EQ(sum.force, expected.force);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum.moment[i], expected.moment[i], 2e-3);
}

TEST_F(VoxelForceTest, WithoutViscosityTheVelocityIsNotEvenRead) {
    const VoxelGrid grid;
    std::vector<PassRecord> records;
    for (const double viscosity : {0.0, 1.0}) {
        gpu.record(&records);
        sum_on_gpu(gpu, grid, grid.random_field(1), grid.random_velocity(2), viscosity);
        gpu.record(nullptr);
        const auto force = std::find_if(records.begin(), records.end(),
                                        [](const PassRecord& r) { return r.pass == "force"; });
        const bool reads = std::count(force->inputs.begin(), force->inputs.end(), "velocity") == 1;
        EXPECT_EQ(reads, viscosity > 0.0);
        records.clear();
    }
}

}  // namespace
}  // namespace eddy::gles
