#include "gles/atlas.h"

#include <gtest/gtest.h>

#include <set>

#include "gles/pass.h"

namespace eddy::gles {
namespace {

const std::vector<glm::ivec3> kSizes{{1, 1, 1},    {4, 4, 4},    {5, 3, 7},    {16, 16, 16}, {17, 17, 17},
                                     {25, 25, 25}, {33, 47, 29}, {96, 48, 48}, {48, 96, 48}, {48, 48, 96},
                                     {128, 8, 8},  {8, 8, 128},  {8, 128, 8},  {1, 1, 100},  {100, 1, 1},
                                     {64, 64, 1},  {2, 64, 63}};

TEST(AtlasLayout, GivesEachIndexItsOwnTexelInsideTheTexture) {
    for (const glm::ivec3& size : kSizes) {
        const AtlasLayout layout = AtlasLayout::tile(size);
        const glm::ivec2 texture = layout.texels();
        std::vector<bool> taken(static_cast<std::size_t>(texture.x * texture.y));
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const glm::ivec2 t = layout.texel({x, y, z});
                    ASSERT_TRUE(t.x >= 0 && t.y >= 0 && t.x < texture.x && t.y < texture.y);
                    const auto i = static_cast<std::size_t>(t.y * texture.x + t.x);
                    ASSERT_FALSE(taken[i])
                        << size.x << "x" << size.y << "x" << size.z << " at " << x << "," << y << "," << z;
                    taken[i] = true;
                }
    }
}

TEST(AtlasLayout, WastesLessThanOneRowOfSlabs) {
    for (const glm::ivec3& size : kSizes) {
        const AtlasLayout layout = AtlasLayout::tile(size);
        const int places = layout.tiles_x * layout.tiles_y();
        EXPECT_GE(places, size.z);
        EXPECT_LT(places - size.z, layout.tiles_x) << size.x << "x" << size.y << "x" << size.z;
        EXPECT_LT(places - size.z, layout.tiles_y()) << size.x << "x" << size.y << "x" << size.z;
    }
}

TEST(AtlasLayout, StaysBelow2048TexelsFor128CellsInAllStorages) {
    // ES 3.0 promises textures of 2048 texels a side, and no more.
    const glm::ivec3 n(128);
    for (const AtlasLayout& layout :
         {Cells::layout(n), Faces::layout(n), Cells4::layout(n), Faces4::layout(n)}) {
        EXPECT_LE(layout.texels().x, 2048);
        EXPECT_LE(layout.texels().y, 2048);
    }
}

TEST(AtlasLayout, OfFourLayersHoldsEveryLayerAndLessThanFourMore) {
    for (const glm::ivec3& n : kSizes) {
        EXPECT_GE(4 * Cells4::layout(n).size.z, n.z);
        EXPECT_LT(4 * Cells4::layout(n).size.z, n.z + 4);
        EXPECT_GE(4 * Faces4::layout(n).size.z, n.z + 1);
        EXPECT_LT(4 * Faces4::layout(n).size.z, n.z + 5);
        EXPECT_EQ(Faces::layout(n).size, n + 1);
        EXPECT_EQ(Cells::layout(n).size, n);
    }
}

Box box(const glm::ivec3& lo, const glm::ivec3& hi) {
    return {lo, hi};
}

/// The cells of a box, one by one.
std::set<std::tuple<int, int, int>> cells(const Box& b) {
    std::set<std::tuple<int, int, int>> all;
    for (int z = b.lo.z; z < b.hi.z; ++z)
        for (int y = b.lo.y; y < b.hi.y; ++y)
            for (int x = b.lo.x; x < b.hi.x; ++x) all.emplace(x, y, z);
    return all;
}

TEST(Box, IntersectionHoldsTheCellsThatBothHold) {
    const Box a = box({0, 2, 1}, {5, 6, 4}), b = box({3, 0, 2}, {9, 4, 9}), far(box({7, 7, 7}, {9, 9, 9}));
    auto both = cells(a);
    for (auto it = both.begin(); it != both.end();)
        it = cells(b).contains(*it) ? std::next(it) : both.erase(it);
    EXPECT_EQ(cells(a.intersect(b)), both);
    EXPECT_EQ(a.intersect(b), b.intersect(a));
    EXPECT_EQ(a.intersect(a), a);
    EXPECT_TRUE(a.intersect(far).empty());
    EXPECT_FALSE(a.empty());
    EXPECT_TRUE(box({1, 1, 1}, {1, 5, 5}).empty());
}

TEST(Box, GrownAndShrunkIsTheSame) {
    const Box a = box({0, 2, 1}, {5, 6, 4});
    EXPECT_EQ(a.grow(3).grow(-3), a);
    EXPECT_EQ(a.grow(1), box({-1, 1, 0}, {6, 7, 5}));
}

TEST(Box, CoarsenedHoldsTheParentOfEachCellAndNoOther) {
    for (int lo = 0; lo < 5; ++lo)
        for (int hi = lo + 1; hi < 9; ++hi) {
            const Box fine = box({lo, lo, lo}, {hi, hi, hi});
            std::set<std::tuple<int, int, int>> parents;
            for (const auto& [x, y, z] : cells(fine)) parents.emplace(x / 2, y / 2, z / 2);
            EXPECT_EQ(cells(fine.coarsen()), parents) << lo << ".." << hi;
        }
}

TEST(Region, PackedHoldsTheTexelsOfEachLayer) {
    for (int lo = 0; lo < 9; ++lo)
        for (int hi = lo + 1; hi < 14; ++hi) {
            const Box packed = Region::packed({box({1, 2, lo}, {3, 4, hi})}).boxes().at(0);
            EXPECT_EQ(packed.lo, glm::ivec3(1, 2, lo / 4));
            EXPECT_EQ(packed.hi, glm::ivec3(3, 4, (hi - 1) / 4 + 1));
        }
}

}  // namespace
}  // namespace eddy::gles
