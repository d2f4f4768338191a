#include "firmware/vorticity.h"

#include <gtest/gtest.h>

namespace eddy {
namespace {

constexpr double kCell = 0.1;

/// Of u = w x r + shear, with the velocity on faces or in the middle of the cells.
std::vector<glm::vec3> linear_flow(const glm::ivec3& n, bool faces) {
    std::vector<glm::vec3> u;
    const int more = faces ? 1 : 0;
    for (int z = 0; z < n.z + more; ++z)
        for (int y = 0; y < n.y + more; ++y)
            for (int x = 0; x < n.x + more; ++x) {
                const glm::dvec3 low = kCell * glm::dvec3(x, y, z), middle = low + 0.5 * kCell;
                const glm::dvec3 at = faces ? low : middle;
                u.emplace_back(at.x - 3.0 * middle.y + 5.0 * middle.z, 2.0 * middle.x - at.y + middle.z,
                               4.0 * middle.x + 7.0 * middle.y + at.z);
            }
    return u;
}

TEST(Vorticity, OfALinearFlowIsExactInEveryCell) {
    const glm::ivec3 n(5, 6, 4);
    for (const bool faces : {false, true}) {
        const std::vector<glm::vec3> w = vorticity(linear_flow(n, faces), n, kCell);
        ASSERT_EQ(w.size(), 120u);
        for (const glm::vec3& v : w) {
            EXPECT_NEAR(v.x, 7.0 - 1.0, 1e-4);
            EXPECT_NEAR(v.y, 5.0 - 4.0, 1e-4);
            EXPECT_NEAR(v.z, 2.0 + 3.0, 1e-4);
        }
    }
}

}  // namespace
}  // namespace eddy
