#include "gles/yang2009/halving_sum.h"

#include <numeric>

#include "tests/gles/gl_fixture.h"
#include "tests/gles/yang2009/voxel_grid.h"

namespace eddy::gles {
namespace {

using HalvingSumTest = GlTest;

struct Totals {
    glm::dvec3 gpu, cpu;
};

Totals total(Gpu& gpu, const glm::ivec3& n) {
    VoxelGrid grid;
    grid.n = n;
    const std::vector<float> x = grid.random_field(1), y = grid.random_field(2);
    std::vector<glm::vec3> values(grid.count());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = {x[i], y[i], 1.0f};
    Field<Cells> field(gpu, n, Format::RGBA32F);
    field.texture().upload(&pack_vectors(values, field.layout())[0].x);

    HalvingSum sum(gpu, "sum", n, 3);
    const TexturePool::Lease row = gpu.textures().lease({3, 1}, Format::RGBA32F);
    clear(*row.get());
    sum.draw(field.texture(), *row, 1);
    const std::vector<glm::vec4> texels = row.get()->download();
    EXPECT_EQ(texels[0], glm::vec4(0.0f)) << "the neighbours of the result must be left alone";
    EXPECT_EQ(texels[2], glm::vec4(0.0f));
    return {glm::dvec3(texels[1]),
            std::accumulate(values.begin(), values.end(), glm::dvec3(0.0),
                            [](glm::dvec3 a, glm::vec3 b) { return a + glm::dvec3(b); })};
}

TEST_F(HalvingSumTest, EqualsThePlainSumOnOddSizes) {
    for (const glm::ivec3 n : {glm::ivec3(7, 5, 3), glm::ivec3(1), glm::ivec3(2, 1, 1), glm::ivec3(33, 17, 9),
                               glm::ivec3(1, 1, 29), glm::ivec3(16)}) {
        SCOPED_TRACE(testing::Message() << n.x << " x " << n.y << " x " << n.z);
        const Totals t = total(gpu, n);
        EXPECT_EQ(t.gpu.z, t.cpu.z);          // counts are exact
        EXPECT_NEAR(t.gpu.x, t.cpu.x, 1e-4);  // the tree rounds log2(N) times, sums stay below 100
        EXPECT_NEAR(t.gpu.y, t.cpu.y, 1e-4);
    }
}

TEST_F(HalvingSumTest, TakesOnePassForEachHalving) {
    HalvingSum sum(gpu, "sum", glm::ivec3(33, 4, 4), 1);
    const Field<Cells> field(gpu, glm::ivec3(33, 4, 4), Format::RGBA32F);
    const TexturePool::Lease row = gpu.textures().lease({1, 1}, Format::RGBA32F);
    std::vector<PassRecord> records;
    gpu.record(&records);
    sum.draw(field.texture(), *row, 0);
    gpu.record(nullptr);
    EXPECT_EQ(records.size(), 6u);  // 33 17 9 5 3 2 1
}

}  // namespace
}  // namespace eddy::gles
