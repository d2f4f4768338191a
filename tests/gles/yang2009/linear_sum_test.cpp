#include "gles/yang2009/linear_sum.h"

#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using LinearSumTest = GlTest;

TEST_F(LinearSumTest, EqualsTheHalvingSumAndReadsNothingBeyondTheGrid) {
    for (const glm::ivec3 n :
         {glm::ivec3(7, 5, 3), glm::ivec3(1), glm::ivec3(33, 17, 9), glm::ivec3(11, 9, 13), glm::ivec3(16)}) {
        SCOPED_TRACE(testing::Message() << n.x << " x " << n.y << " x " << n.z);
        VoxelGrid grid;
        grid.n = n;
        const AtlasLayout layout = Cells::layout(n);
        // Every texel first holds what must not be counted; then each cell gets its own number.
        std::vector<glm::vec4> texels(static_cast<std::size_t>(layout.texels().x * layout.texels().y),
                                      glm::vec4(1e6f));
        const std::vector<glm::vec3> values = grid.random_velocity(4);
        grid.for_each_cell([&](const glm::ivec3& c) {
            const glm::ivec2 t = layout.texel(c);
            texels[static_cast<std::size_t>(t.y * layout.texels().x + t.x)] =
                glm::vec4(values[grid.index(c)], 1.0f);
        });
        Field<Cells> source(gpu, n, Format::RGBA32F);
        source.texture().upload(&texels[0].x);

        TexturePool::Lease row = gpu.textures().lease({4, 1}, Format::RGBA32F);
        clear(*row.get());
        LinearSum linear(gpu, "linear", n, 4);
        HalvingSum halving(gpu, "halving", n, 4);
        linear.draw(source.texture(), *row, 1);
        halving.draw(source.texture(), *row, 2);
        const std::vector<glm::vec4> sums = row.get()->download();
        EXPECT_EQ(sums[0], glm::vec4(0.0f)) << "the neighbours of the result must be left alone";
        EXPECT_EQ(sums[3], glm::vec4(0.0f));
        EXPECT_EQ(sums[1].w, static_cast<float>(grid.count()));
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(sums[1][i], sums[2][i], 1e-4);  // sums stay below 100
    }
}

}  // namespace
}  // namespace eddy::gles
