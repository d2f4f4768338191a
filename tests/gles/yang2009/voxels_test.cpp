#include "gles/yang2009/voxels.h"

#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using VoxelsTest = GlTest;

CellType type_by_definition(const VoxelGrid& grid, const glm::ivec3& c) {
    bool touches_solid = false, touches_fluid = false;
    for (const glm::ivec3& e : kSixWays) {
        if (!grid.in_tank(c + e)) continue;
        (grid.solid(c + e) ? touches_solid : touches_fluid) = true;
    }
    if (grid.solid(c)) return touches_fluid ? CellType::Boundary : CellType::Inside;
    return touches_solid ? CellType::Surrounding : CellType::Outside;
}

void expect_types_by_definition(Gpu& gpu, const VoxelGrid& grid) {
    const Voxels voxels = grid.voxels(gpu);
    const std::vector<glm::vec4> texels = voxels.texture().download();
    int count[4] = {};
    grid.for_each_cell([&](const glm::ivec3& c) {
        const glm::ivec2 t = voxels.layout().texel(c);
        const glm::vec4 io = texels[static_cast<std::size_t>(t.y * voxels.layout().texels().x + t.x)];
        const CellType type = type_by_definition(grid, c);
        ++count[static_cast<int>(type)];
        ASSERT_EQ(static_cast<CellType>(static_cast<int>(io.w)), type)
            << "cell " << c.x << ' ' << c.y << ' ' << c.z;
        const glm::dvec3 moves = grid.velocity + glm::cross(grid.spin, glm::dvec3(c) + 0.5 - grid.centre);
        const glm::vec3 expected = grid.solid(c) ? glm::vec3(moves) : glm::vec3(0.0f);
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(io[i], expected[i], 2e-6f);
    });
    for (int type = 0; type < 4; ++type)
        EXPECT_GT(count[type], 0) << "this tank has no cell of type " << type;
}

TEST_F(VoxelsTest, FourTypesAroundASphereEqualAPlainLoop) {
    expect_types_by_definition(gpu, VoxelGrid{});
}

TEST_F(VoxelsTest, SpinningSphereWritesItsVelocityCellByCell) {
    VoxelGrid grid;
    grid.spin = {1.0, 2.0, -0.5};
    expect_types_by_definition(gpu, grid);
}

TEST_F(VoxelsTest, WallOfTheTankIsNobodysNeighbour) {
    VoxelGrid grid;
    grid.centre = {0.4, 4.4,
                   6.7};  // half of the sphere sticks out: its cells at the wall have no fluid beyond it
    expect_types_by_definition(gpu, grid);
}

}  // namespace
}  // namespace eddy::gles
