#include "gles/yang2009/force.h"

#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using VoxelForceTest = GlTest;

struct Sum {
    glm::dvec3 force{0.0}, moment{0.0};
};

/// -phi n over the faces between sphere and fluid, phi from the fluid's side, the moment from the face's
/// centre.
Sum sum_over_faces(const VoxelGrid& grid, const std::vector<float>& phi) {
    Sum sum;
    grid.for_each_cell([&](const glm::ivec3& c) {
        if (!grid.solid(c)) return;
        for (const glm::ivec3& n : kSixWays) {
            if (!grid.in_tank(c + n) || grid.solid(c + n)) continue;
            const glm::dvec3 f = -static_cast<double>(phi[grid.index(c + n)]) * glm::dvec3(n);
            sum.force += f;
            sum.moment += glm::cross(glm::dvec3(c) + 0.5 + 0.5 * glm::dvec3(n) - grid.centre, f);
        }
    });
    return sum;
}

Sum sum_on_gpu(Gpu& gpu, const VoxelGrid& grid, const std::vector<float>& phi) {
    const Voxels voxels = grid.voxels(gpu);
    VoxelForce force(gpu, grid.n, 1.0, grid.bodies(), 3);
    const TexturePool::Lease results = gpu.textures().lease({3, 1}, Format::RGBA32F);
    force.draw(grid.upload(gpu, phi), voxels, grid.uniforms(), {grid.state()}, *results);
    const std::vector<glm::vec4> texels = results.get()->download();
    return {glm::dvec3(texels[0]), glm::dvec3(texels[1])};
}

TEST_F(VoxelForceTest, EqualsAPlainSumOverFaces) {
    const VoxelGrid grid;
    const std::vector<float> phi = grid.random_field(11);
    const Sum expected = sum_over_faces(grid, phi), found = sum_on_gpu(gpu, grid, phi);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.force[i], expected.force[i], 1e-5);  // about 150 terms up to 1
        EXPECT_NEAR(found.moment[i], expected.moment[i], 5e-5);
    }
    EXPECT_GT(glm::length(expected.force), 1.0);
}

TEST_F(VoxelForceTest, UniformPressurePushesNowhere) {
    const VoxelGrid grid;
    const Sum sum = sum_on_gpu(gpu, grid, std::vector<float>(grid.count(), 3.0f));
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
    const Sum sum = sum_on_gpu(gpu, grid, phi);
    EXPECT_EQ(sum.force, glm::dvec3(0.0, -(volume + shadow), 0.0));
}

}  // namespace
}  // namespace eddy::gles
