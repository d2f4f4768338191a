#include "gles/grid_io.h"

#include <gtest/gtest.h>

namespace eddy::gles {
namespace {

const std::vector<glm::ivec3> kGrids{{1, 1, 1}, {4, 4, 4}, {5, 6, 7}, {9, 3, 13}, {16, 2, 5}};

TEST(GridIo, UnpacksVectorsAsTheyWerePacked) {
    for (const glm::ivec3& n : kGrids) {
        const AtlasLayout layout = Faces::layout(n);
        std::vector<glm::vec3> values(
            static_cast<std::size_t>(layout.size.x * layout.size.y * layout.size.z));
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = glm::vec3(static_cast<float>(i), -static_cast<float>(i), 0.5f);
        EXPECT_EQ(unpack_vectors(pack_vectors(values, layout), layout), values);
    }
}

TEST(GridIo, UnpacksLayersOfFourAsTheyWerePacked) {
    for (const glm::ivec3& n : kGrids) {
        const AtlasLayout layout = Cells4::layout(n);
        std::vector<float> values(static_cast<std::size_t>(n.x * n.y * n.z));
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) + 1.0f;
        const std::vector<glm::vec4> texels = pack_four(values, layout, n);
        EXPECT_EQ(unpack_four(texels, layout, n), values);
        // What pads the last slab is zero: finite, and neutral in sums.
        double total = 0.0, wanted = 0.0;
        for (const glm::vec4& t : texels) total += t.x + t.y + t.z + t.w;
        for (const float v : values) wanted += v;
        EXPECT_EQ(total, wanted);
    }
}

TEST(GridIo, PutsXFastestThenYThenZ) {
    const glm::ivec3 n(3, 4, 5);
    const AtlasLayout layout = Cells::layout(n);
    std::vector<glm::vec4> texels(static_cast<std::size_t>(layout.texels().x * layout.texels().y));
    const glm::ivec2 t = layout.texel({2, 1, 3});
    texels[static_cast<std::size_t>(t.y * layout.texels().x + t.x)].x = 7.0f;
    EXPECT_EQ(unpack_scalars(texels, layout)[static_cast<std::size_t>((3 * n.y + 1) * n.x + 2)], 7.0f);
    std::vector<float> values(60);
    values[static_cast<std::size_t>((3 * n.y + 1) * n.x + 2)] = 7.0f;
    const AtlasLayout four = Cells4::layout(n);
    const glm::ivec2 t4 = four.texel({2, 1, 0});
    EXPECT_EQ(pack_four(values, four, n)[static_cast<std::size_t>(t4.y * four.texels().x + t4.x)],
              glm::vec4(0.0f, 0.0f, 0.0f, 7.0f));
}

}  // namespace
}  // namespace eddy::gles
