#include "config/nearest.h"

#include <gtest/gtest.h>

namespace eddy {
namespace {

TEST(Nearest, DistanceCountsEachSlipOfTheFingerOnce) {
    EXPECT_EQ(edit_distance("radius_m", "radius_m"), 0u);
    EXPECT_EQ(edit_distance("radus_m", "radius_m"), 1u);    // dropped
    EXPECT_EQ(edit_distance("raddius_m", "radius_m"), 1u);  // added
    EXPECT_EQ(edit_distance("radios_m", "radius_m"), 1u);   // replaced
    EXPECT_EQ(edit_distance("raduis_m", "radius_m"), 1u);   // swapped
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
}

TEST(Nearest, DistanceIsSymmetric) {
    EXPECT_EQ(edit_distance("velocity_m_s", "oscillation"), edit_distance("oscillation", "velocity_m_s"));
    EXPECT_EQ(edit_distance("ca", "abc"), edit_distance("abc", "ca"));
}

TEST(Nearest, SortsByDistanceAndKeepsTheOrderOfTies) {
    const std::vector<std::string_view> sorted = {"slip", "slap", "open"};
    EXPECT_EQ(nearest_first("slip", {"open", "slap", "slip"}), sorted);
    const std::vector<std::string_view> tied = {"b", "a", "c"};
    EXPECT_EQ(nearest_first("x", {"b", "a", "c"}), tied);
}

}  // namespace
}  // namespace eddy
